// SPDX-License-Identifier: Apache-2.0
#include "materials/material_cost.hpp"

#include <algorithm>
#include <chrono>

#include "generated/materials.hpp"
#include "solver/base/error.hpp"

namespace scree {

// Instantiated in the units that CMake writes.
template <class M, class T>
std::unique_ptr<MaterialCalls> calls_of(const std::any& input);

std::unique_ptr<MaterialCalls> make_material_calls(const std::string& model, const std::any& input,
                                                   bool single_precision) {
#define SCREE_MATERIAL(header, Type)                                                        \
  if (model == Type::name) {                                                                \
    return single_precision ? calls_of<Type, float>(input) : calls_of<Type, double>(input); \
  }
#include "generated/materials.def"
#undef SCREE_MATERIAL
  throw UserError("this build has no material " + model);
}

double material_cost(const std::string& model, const std::any& input, bool single_precision,
                     double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto calls = make_material_calls(model, input, single_precision);
  constexpr int rounds = 200;
  double best = 1e300;
  const auto start = Clock::now();
  do {
    const auto begin = Clock::now();
    for (int n = 0; n < rounds; ++n) calls->round();
    const double elapsed = std::chrono::duration<double>(Clock::now() - begin).count();
    best = std::min(best, elapsed);
  } while (std::chrono::duration<double>(Clock::now() - start).count() < seconds);
  return 1e9 * best / (double(rounds) * calls->particles());
}

}  // namespace scree
