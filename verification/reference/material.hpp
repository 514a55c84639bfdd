// SPDX-License-Identifier: Apache-2.0
//
// Constitutive laws of the reference method, through Eigen's SVD. Slow and obvious on purpose; no
// code shared with materials/.
#pragma once

#include <memory>

#include "verification/reference/kernel.hpp"

namespace scree::reference {

/// History of one particle.
struct MaterialState {
  Matrix F = Matrix::Identity();  ///< deformation gradient; after plastic flow its elastic part
  Matrix tau = Matrix::Zero();    ///< Kirchhoff stress of the last update [Pa]
  double log_volume_ratio = 0;    ///< ln of the total volume ratio
  double volume_correction = 0;   ///< drucker_prager: plastic expansion not yet undone
  double equivalent_plastic_strain = 0;
};

class Material {
 public:
  virtual ~Material() = default;
  /// Carries the state over a step with velocity gradient L [1/s] and returns the Kirchhoff stress
  /// [Pa], also kept in state.tau.
  Matrix advance(MaterialState& state, const Matrix& L, double dt) const;
  /// Elastic energy per reference volume [J/m^3].
  virtual double energy_density(const MaterialState& state) const = 0;

 private:
  virtual Matrix kirchhoff(MaterialState& state, const Matrix& L, double dt) const = 0;
  /// J_new/J_old of a step: det(I + dt L) for solids, 1 + dt tr L for the fluid.
  virtual double volume_factor(const Matrix& L, double dt) const;
};

/// lambda and mu [Pa] of Young's modulus [Pa] and Poisson's ratio.
struct Lame {
  double lambda, mu;
  Lame(double youngs_modulus, double poissons_ratio);
  double bulk() const { return lambda + 2 * mu / 3; }
};

/// tau = U diag(2 mu (S_i - 1) S_i + lambda J (J - 1)) U^T.
std::unique_ptr<Material> fixed_corotated(double youngs_modulus, double poissons_ratio);

/// psi = mu/2 (tr b - 3) - mu ln J + lambda/2 (ln J)^2, tau = mu (b - I) + lambda ln J I.
std::unique_ptr<Material> neo_hookean(double youngs_modulus, double poissons_ratio);

struct DruckerPragerInput {
  double youngs_modulus, poissons_ratio;
  double alpha;                ///< sqrt(2/27) M of the cone q = M p
  double dilation = 0;         ///< the same number of the dilation cone
  double cohesion_strain = 0;  ///< c cot(phi)/(3 lambda + 2 mu)
};

/// Klar et al., ACM TOG 35(4), 2016, with the volume correction of Tampubolon et al., ACM TOG
/// 36(4), 2017.
std::unique_ptr<Material> drucker_prager(const DruckerPragerInput& input);

/// p = B (J^-gamma - 1), tau = J (eta (L + L^T) - p I).
std::unique_ptr<Material> j_fluid(double bulk_modulus, double gamma, double viscosity);

}  // namespace scree::reference
