// SPDX-License-Identifier: Apache-2.0
#include "materials/material_cost.hpp"
#include "materials/typical_input.hpp"
#include "verification/benchmark/benchmarks.hpp"

namespace scree::benchmarks {

void add_materials() {
  for (const MaterialEntry& entry : material_registry()) {
    for (const bool single : {true, false}) {
      add("kirchhoff/" + entry.name + (single ? "/float" : "/double"),
          [&entry, single](benchmark::State& state) {
            const auto calls = make_material_calls(entry.name, typical_input(entry, 3), single);
            for (auto _ : state) {
              calls->round();
              benchmark::ClobberMemory();
            }
            count(state, calls->particles(), "particle");
          });
    }
  }
}

}  // namespace scree::benchmarks
