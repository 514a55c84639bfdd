// SPDX-License-Identifier: Apache-2.0
#include "verification/reference/material.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

namespace scree::reference {

namespace {

struct Decomposition {
  Matrix U, V;
  Vector S;
  explicit Decomposition(const Matrix& F) {
    const Eigen::JacobiSVD<Matrix> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
    U = svd.matrixU();
    V = svd.matrixV();
    S = svd.singularValues();
  }
};

Matrix rotated(const Matrix& U, const Vector& diagonal) {
  return U * diagonal.asDiagonal() * U.transpose();
}

class FixedCorotated : public Material {
 public:
  FixedCorotated(double youngs_modulus, double poissons_ratio)
      : lame_(youngs_modulus, poissons_ratio) {}

  double energy_density(const MaterialState& state) const override {
    const Vector S = Decomposition(state.F).S;
    const double J = S.prod();
    return lame_.mu * (S.array() - 1).square().sum() + lame_.lambda / 2 * (J - 1) * (J - 1);
  }

 private:
  Matrix kirchhoff(MaterialState& state, const Matrix& L, double dt) const override {
    state.F = (Matrix::Identity() + dt * L) * state.F;
    const Decomposition svd(state.F);
    const double J = svd.S.prod();
    const Vector principal =
        2 * lame_.mu * (svd.S.array() - 1) * svd.S.array() + lame_.lambda * J * (J - 1);
    return rotated(svd.U, principal);
  }
  Lame lame_;
};

class NeoHookean : public Material {
 public:
  NeoHookean(double youngs_modulus, double poissons_ratio)
      : lame_(youngs_modulus, poissons_ratio) {}

  double energy_density(const MaterialState& state) const override {
    const double log_J = std::log(state.F.determinant());
    return lame_.mu * (state.F.squaredNorm() - 3) / 2 - lame_.mu * log_J +
           lame_.lambda / 2 * log_J * log_J;
  }

 private:
  Matrix kirchhoff(MaterialState& state, const Matrix& L, double dt) const override {
    state.F = (Matrix::Identity() + dt * L) * state.F;
    const Matrix I = Matrix::Identity();
    return lame_.mu * (state.F * state.F.transpose() - I) +
           lame_.lambda * std::log(state.F.determinant()) * I;
  }
  Lame lame_;
};

class DruckerPrager : public Material {
 public:
  explicit DruckerPrager(const DruckerPragerInput& input)
      : input_(input), lame_(input.youngs_modulus, input.poissons_ratio) {}

  double energy_density(const MaterialState& state) const override {
    const Vector strain = Decomposition(state.F).S.array().log();
    return lame_.mu * strain.squaredNorm() + lame_.lambda / 2 * strain.sum() * strain.sum();
  }

 private:
  Matrix kirchhoff(MaterialState& state, const Matrix& L, double dt) const override {
    const Decomposition svd((Matrix::Identity() + dt * L) * state.F);
    const double shift = input_.cohesion_strain;
    const Vector trial = svd.S.array().log();
    const Vector e = project(trial.array() + state.volume_correction / 3 - shift, state);
    const Vector strain = e.array() + shift;
    const Vector stretch = strain.array().exp();
    state.F = svd.U * stretch.asDiagonal() * svd.V.transpose();
    return rotated(svd.U, 2 * lame_.mu * strain.array() + lame_.lambda * strain.sum());
  }

  /// Returns `e` to the cone whose tip is at 0; sets the volume correction and the plastic strain.
  Vector project(const Vector& e, MaterialState& state) const {
    const double t = e.sum();
    const Vector deviator = e.array() - t / 3;
    const double norm = deviator.norm();
    if (t >= 0) {
      state.volume_correction = t;
      state.equivalent_plastic_strain += std::sqrt(2.0 / 3.0) * norm;
      return Vector::Zero();
    }
    state.volume_correction = 0;
    const double dg =
        (norm + (3 * lame_.lambda + 2 * lame_.mu) / (2 * lame_.mu) * t * input_.alpha) /
        (1 + 9 * lame_.bulk() * input_.alpha * input_.dilation / (2 * lame_.mu));
    if (dg <= 0) return e;
    state.equivalent_plastic_strain += std::sqrt(2.0 / 3.0) * dg;
    return e - dg * (deviator / norm + input_.dilation * Vector::Ones());
  }

  DruckerPragerInput input_;
  Lame lame_;
};

class JFluid : public Material {
 public:
  JFluid(double bulk_modulus, double gamma, double viscosity)
      : bulk_modulus_(bulk_modulus), gamma_(gamma), viscosity_(viscosity) {}

  /// Integral of p over -dJ from 1 to J.
  double energy_density(const MaterialState& state) const override {
    const double J = std::exp(state.log_volume_ratio);
    return bulk_modulus_ * ((std::pow(J, 1 - gamma_) - 1) / (gamma_ - 1) + J - 1);
  }

 private:
  double volume_factor(const Matrix& L, double dt) const override { return 1 + dt * L.trace(); }

  Matrix kirchhoff(MaterialState& state, const Matrix& L, double /*dt*/) const override {
    const double J = std::exp(state.log_volume_ratio);
    const double pressure = bulk_modulus_ * (std::pow(J, -gamma_) - 1);
    return J * (viscosity_ * (L + L.transpose()) - pressure * Matrix::Identity());
  }
  double bulk_modulus_, gamma_, viscosity_;
};

}  // namespace

Matrix Material::advance(MaterialState& state, const Matrix& L, double dt) const {
  state.log_volume_ratio += std::log(volume_factor(L, dt));
  state.tau = kirchhoff(state, L, dt);
  return state.tau;
}

double Material::volume_factor(const Matrix& L, double dt) const {
  return (Matrix::Identity() + dt * L).determinant();
}

Lame::Lame(double youngs_modulus, double poissons_ratio)
    : lambda(youngs_modulus * poissons_ratio / ((1 + poissons_ratio) * (1 - 2 * poissons_ratio))),
      mu(youngs_modulus / (2 * (1 + poissons_ratio))) {}

std::unique_ptr<Material> fixed_corotated(double youngs_modulus, double poissons_ratio) {
  return std::make_unique<FixedCorotated>(youngs_modulus, poissons_ratio);
}

std::unique_ptr<Material> neo_hookean(double youngs_modulus, double poissons_ratio) {
  return std::make_unique<NeoHookean>(youngs_modulus, poissons_ratio);
}

std::unique_ptr<Material> drucker_prager(const DruckerPragerInput& input) {
  return std::make_unique<DruckerPrager>(input);
}

std::unique_ptr<Material> j_fluid(double bulk_modulus, double gamma, double viscosity) {
  return std::make_unique<JFluid>(bulk_modulus, gamma, viscosity);
}

}  // namespace scree::reference
