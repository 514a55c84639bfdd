// SPDX-License-Identifier: Apache-2.0
#include "solver/simulation/particle_fields.hpp"

namespace scree {

const std::vector<ParticleField>& particle_fields() {
  using Q = FieldQuantity;
  static const std::vector<ParticleField> fields{
      {"velocity", "m/s", 3, Q::velocity, "Velocity; z is 0 in 2D."},
      {"stress", "Pa", 9, Q::stress,
       "Cauchy stress, total where there is pore water, rows xx xy xz yx yy yz zx zy zz, tension "
       "positive."},
      {"effective_stress", "Pa", 9, Q::effective_stress,
       "Stress plus the excess pore pressure on its diagonal; NaN without pore water.", true},
      {"pressure", "Pa", 1, Q::pressure,
       "Minus a third of the trace of `stress`, compression positive."},
      {"p", "Pa", 1, Q::p, "Mean effective stress, compression positive."},
      {"q", "Pa", 1, Q::q,
       "Deviatoric stress sqrt(3/2) |s|, s the deviator of the stress; never negative. The "
       "difference of axial and radial stress in a triaxial test."},
      {"von_mises", "Pa", 1, Q::q, "The same as q, by its other name."},
      {"lode_angle", "rad", 1, Q::lode_angle,
       "From 0 in triaxial compression to pi/3 in triaxial extension, pi/6 in pure shear; NaN "
       "where q is 0."},
      {"principal_stress", "Pa", 3, Q::principal_stress,
       "Principal effective stresses, compression positive, the largest first."},
      {"principal_directions", "1", 9, Q::principal_directions,
       "Rows are unit vectors along the principal stresses, in their order; their sign has no "
       "meaning."},
      {"mobilised_friction", "rad", 1, Q::mobilised_friction,
       "Angle phi of sin phi = (s1 - s3)/(s1 + s3), effective principal stresses, compression "
       "positive, from 0 to pi/2; NaN where s3 is tensile or nothing is stressed."},
      {"yield_distance", "1", 1, Q::yield_distance,
       "Minus the law's yield function over its scale of stress: positive inside of the yield "
       "surface, 0 on it, negative beyond it (rates); NaN where the law has no yield function."},
      {"equivalent_plastic_shear_strain", "1", 1, Q::equivalent_plastic_shear_strain,
       "Sum of sqrt(2/3) |deviator of the plastic strain increment|, never negative: the law's "
       "equivalent_plastic_strain; NaN where the law keeps none."},
      {"strain_rate", "1/s", 9, Q::strain_rate,
       "Symmetric velocity gradient of the last step, extension positive; with flip and pic NaN at "
       "t = 0."},
      {"mass", "kg", 1, Q::mass, "Mass; in 2D per metre of thickness."},
      {"volume", "m^3", 1, Q::volume, "Current volume; in 2D per metre of thickness."},
      {"volume_ratio", "1", 1, Q::volume_ratio,
       "J, current over initial volume, plastic part included; positive."},
      {"displacement", "m", 3, Q::displacement,
       "From the position at t = 0; across a periodic face it jumps by the width of the domain."},
  };
  return fields;
}

}  // namespace scree
