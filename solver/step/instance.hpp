// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/step/material_body.hpp"
#include "solver/step/material_factory.hpp"

namespace scree {

template <class Material, int D, class T>
std::unique_ptr<Body<D, T>> make_material_body(const BodyInfo& info, const std::any& input) {
  const auto& values = std::any_cast<const typename Material::Input&>(input);
  return std::make_unique<MaterialBody<Material, D, T>>(info, values);
}

}  // namespace scree

/// Compiles one law for one dimension and precision; one translation unit each, written by CMake.
#define SCREE_INSTANTIATE(Type, D, real)                                                      \
  namespace scree {                                                                           \
  template std::unique_ptr<Body<D, real>> make_material_body<Type, D, real>(const BodyInfo&,  \
                                                                            const std::any&); \
  }
