// SPDX-License-Identifier: Apache-2.0
#include "materials/material_point.hpp"

#include "generated/materials.hpp"

namespace scree {

template <class M>
std::unique_ptr<MaterialPoint> make_point_of(const std::any& input, double density, int dimension);

std::unique_ptr<MaterialPoint> make_material_point(const std::string& model, const std::any& input,
                                                   double density, int dimension) {
#define SCREE_MATERIAL(header, Type) \
  if (model == Type::name) return make_point_of<Type>(input, density, dimension);
#include "generated/materials.def"
#undef SCREE_MATERIAL
  return nullptr;
}

}  // namespace scree
