// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <any>
#include <memory>

#include "solver/step/body.hpp"

namespace scree {

/// Makes a body of the law Material; defined in the law's generated translation units.
template <class Material, int D, class T>
std::unique_ptr<Body<D, T>> make_material_body(const BodyInfo& info, const std::any& input);

}  // namespace scree
