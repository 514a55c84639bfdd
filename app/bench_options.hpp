// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace scree {

/// The command line of `scree bench`.
struct BenchOptions {
  std::string case_name = "elastic";     ///< elastic, sand, fluid, coupled
  int dimension = 3;                     ///< 2 or 3
  std::int64_t particles = 1'000'000;    ///< about
  int per_direction = 0;                 ///< particles an axis and cell; 0: the case's own
  std::string soil = "fixed_corotated";  ///< law of the case coupled
  int steps = 0;                         ///< timed steps; 0: as many as a good measurement needs
  std::string precision = "double";      ///< double, single
  std::string kernel = "compact";        ///< compact, quadratic
  std::string path = "automatic";        ///< automatic, fused, split
  int threads = 0;                       ///< 0: all cores
  std::string backend = "cpu";           ///< auto, cpu, cuda
  std::string deck;                      ///< a deck instead of a case; empty: none
  std::vector<std::string> overrides;    ///< KEY=VALUE of the deck
  bool material_only = false;            ///< what the laws cost by themselves
  bool suite = false;                    ///< table of cases, sweep of sizes and memory bandwidth
  bool quick = false;                    ///< the suite with tiny sizes, to see that it works
  bool json = false;
  bool dry = false;  ///< the case coupled without its water, to compare
};

}  // namespace scree
