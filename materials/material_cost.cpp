// SPDX-License-Identifier: Apache-2.0
#include "materials/material_cost.hpp"

#include "generated/materials.hpp"
#include "solver/base/error.hpp"

namespace scree {

// Instantiated in the units that CMake writes.
template <class M, class T>
double cost_of(const std::any& input, double seconds);

double material_cost(const std::string& model, const std::any& input, bool single_precision,
                     double seconds) {
#define SCREE_MATERIAL(header, Type)                                 \
  if (model == Type::name) {                                         \
    return single_precision ? cost_of<Type, float>(input, seconds)   \
                            : cost_of<Type, double>(input, seconds); \
  }
#include "generated/materials.def"
#undef SCREE_MATERIAL
  throw UserError("this build has no material " + model);
}

}  // namespace scree
