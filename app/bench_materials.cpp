// SPDX-License-Identifier: Apache-2.0
#include "app/bench_materials.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "materials/material_cost.hpp"
#include "materials/typical_input.hpp"

namespace scree {

void print_material_costs(bool json) {
  constexpr double seconds = 0.1;  // a law and precision
  nlohmann::ordered_json costs;
  if (!json) fmt::print("{:<20}  double ns  single ns   (a particle, one core)\n", "material");
  for (const MaterialEntry& entry : material_registry()) {
    const std::any input = typical_input(entry, 3);
    const double in_double = material_cost(entry.name, input, false, seconds);
    const double in_single = material_cost(entry.name, input, true, seconds);
    costs[entry.name] = {{"double_ns", in_double}, {"single_ns", in_single}};
    if (!json) fmt::print("{:<20}  {:9.2f}  {:9.2f}\n", entry.name, in_double, in_single);
  }
  if (json) fmt::print("{}\n", nlohmann::ordered_json{{"material_cost", costs}}.dump(2));
}

}  // namespace scree
