// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "postproc/run/frame_source.hpp"

namespace scree {

/// One number a particle that a user can name: `pressure`, `velocity.x`, `velocity.magnitude`,
/// `stress.xy`, and of tensors `p` (mean pressure), `q` (sqrt(3/2) of the deviator's norm; the
/// same for `von_mises`), both of a stress that is tension positive.
struct ParticleQuantity {
  std::string name;    ///< as a column is called: "pressure", "stress.xy"
  std::string unit;    ///< "" where it has none or none is known
  std::string field;   ///< that it is taken from; "position" for the place
  int component = -1;  ///< -1: all of the field's components make the number
  enum class Kind { component, magnitude, mean_pressure, deviatoric } kind = Kind::component;
};

/// The quantities behind one word of the user. A vector or tensor without a component gives all
/// its components (symmetric ones once, those along z in 3D only) and a magnitude of a vector.
/// Throws UserError with the names there are.
std::vector<ParticleQuantity> quantities(const std::string& word,
                                         const std::vector<FieldInfo>& fields, int dimension);

/// The same for several words, in order.
std::vector<ParticleQuantity> quantities(const std::vector<std::string>& words,
                                         const std::vector<FieldInfo>& fields, int dimension);

/// What a command takes that was asked for nothing: the speed and the mean pressure, as far as the
/// frames hold them, else their first field.
std::vector<ParticleQuantity> default_quantities(const std::vector<FieldInfo>& fields,
                                                 int dimension);

/// The fields that must be read for these quantities.
std::vector<std::string> needed_fields(const std::vector<ParticleQuantity>& quantities);

/// The quantity of every particle.
std::vector<double> values_of(const ParticleQuantity& quantity, const ParticleSnapshot& snapshot);

/// The SI unit of a field that scree writes, "" if none is known.
std::string unit_of_field(const std::string& name);

}  // namespace scree
