// SPDX-License-Identifier: Apache-2.0
/// \file
/// What the point function of a law costs by itself: no transfer, no traffic of particles.
#pragma once

#include <any>
#include <memory>
#include <string>

namespace scree {

/// Calls of kirchhoff() in SIMD lanes on small states of random strain that stay in the cache. With
/// strains of 1e-3 to and fro, laws with a yield surface flow in part of the calls.
class MaterialCalls {
 public:
  virtual ~MaterialCalls() = default;
  /// One call for every particle.
  virtual void round() = 0;
  virtual int particles() const = 0;
};

/// Throws UserError for a law that this build does not hold.
std::unique_ptr<MaterialCalls> make_material_calls(const std::string& model, const std::any& input,
                                                   bool single_precision);

/// Nanoseconds a particle of one call on this core, the best of some repetitions over about
/// `seconds`. Throws as make_material_calls().
double material_cost(const std::string& model, const std::any& input, bool single_precision,
                     double seconds);

}  // namespace scree
