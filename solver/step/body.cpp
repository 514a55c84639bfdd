// SPDX-License-Identifier: Apache-2.0
#include "solver/step/body.hpp"

#include "generated/materials.hpp"
#include "solver/base/error.hpp"
#include "solver/step/material_factory.hpp"

namespace scree {

template <int D, class T>
std::unique_ptr<Body<D, T>> make_body(const BodyInfo& info, const std::any& input) {
#define SCREE_MATERIAL(header, Type) \
  if (info.model == Type::name) return make_material_body<Type, D, T>(info, input);
#include "generated/materials.def"
#undef SCREE_MATERIAL
  throw UserError("this build holds no material model \"" + info.model + "\"");
}

template std::unique_ptr<Body<2, float>> make_body(const BodyInfo&, const std::any&);
template std::unique_ptr<Body<2, double>> make_body(const BodyInfo&, const std::any&);
template std::unique_ptr<Body<3, float>> make_body(const BodyInfo&, const std::any&);
template std::unique_ptr<Body<3, double>> make_body(const BodyInfo&, const std::any&);

}  // namespace scree
