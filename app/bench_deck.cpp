// SPDX-License-Identifier: Apache-2.0
#include "app/bench_deck.hpp"

#include <filesystem>

#include "app/build_simulation.hpp"
#include "solver/base/error.hpp"

namespace scree {
namespace {

const char* name_of(KernelType kernel) {
  if (kernel == KernelType::compact) return "compact";
  return kernel == KernelType::quadratic ? "quadratic" : "linear";
}

}  // namespace

SimulationSetup build_bench_deck(BenchOptions& options) {
  Problems problems;
  const Deck deck = read_deck(options.deck, options.overrides, problems);
  if (!problems.empty()) throw UserError("this deck cannot be measured:\n" + problems.text());
  SimulationSetup setup = build_setup(deck);
  setup.schedule = Schedule(1e6, 0, 0, 0);
  setup.record = false;
  setup.keep_reference = setup.body_force || !setup.tractions.empty();
  options.case_name = std::filesystem::path(options.deck).stem().string();
  options.dimension = setup.dimension;
  options.kernel = name_of(setup.kernel);
  options.precision = setup.precision == Precision::double_ ? "double" : "single";
  return setup;
}

}  // namespace scree
