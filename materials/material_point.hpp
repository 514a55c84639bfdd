// SPDX-License-Identifier: Apache-2.0
/// \file
/// One point of a material without its C++ type, in double precision: what the element driver and
/// other users outside of the hot loops need.
#pragma once

#include <any>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solver/base/tensor.hpp"

namespace scree {

/// A law, its parameters and one state. Stresses are Kirchhoff, tau = J sigma [Pa], tension
/// positive.
class MaterialPoint {
 public:
  virtual ~MaterialPoint() = default;

  /// One step with the increment L = dt grad v [1]: F <- (I + L) F and return map. Returns the
  /// stress afterwards. `dt` [s], above 0, gives rates to laws that depend on them.
  virtual Sym3<double> advance(const Mat3<double>& increment, double dt) = 0;

  virtual Sym3<double> stress() const = 0;    ///< of the present state, with the last step's rates
  virtual double volume_ratio() const = 0;    ///< total J, plastic part included
  virtual double energy_density() const = 0;  ///< elastic, per reference volume [J/m^3]
  virtual double wave_speed() const = 0;      ///< bound of the speed of small waves [m/s]
  virtual bool admissible() const = 0;        ///< false: the state has left the domain of the law

  /// Yield function of the present state over the law's scale of stress, <= 0 inside; nothing
  /// where the law has no yield surface.
  virtual std::optional<double> yield_value() const = 0;
  /// Pores over solids, volume by volume [1]; nothing where the law does not know it.
  virtual std::optional<double> void_ratio() const = 0;

  /// The state as numbers, in the order of the law's fields().
  virtual std::vector<double> entries() const = 0;
  /// Puts a state back. As many numbers as entries() gives.
  virtual void set_entries(std::span<const double> values) = 0;
};

/// An undeformed point of the named model, or null where this build has no such model. `input`
/// holds the model's Input; `density` [kg/m^3]; `dimension` 2 (plane strain) or 3, where defaults
/// of the law depend on it.
std::unique_ptr<MaterialPoint> make_material_point(const std::string& model, const std::any& input,
                                                   double density, int dimension);

}  // namespace scree
