// SPDX-License-Identifier: Apache-2.0
#include "solver/element/motion.hpp"

#include <cmath>

namespace scree {
namespace {

Mat3<double> diagonal(double a, double b, double c) {
  Mat3<double> m = zero3<double>();
  m(0, 0) = a;
  m(1, 1) = b;
  m(2, 2) = c;
  return m;
}

/// F = diag(exp(-a c + d x), exp(-b c + e x), the same).
class AxialMotion final : public Motion {
 public:
  struct Rates {
    double axial, lateral;
  };
  AxialMotion(Rates by_control, Rates by_free) : by_control_(by_control), by_free_(by_free) {}

  Mat3<double> increment(const PathState& from, const PathState& to) const override {
    const double control = to.control - from.control, free = to.free - from.free;
    const double axial = -by_control_.axial * control + by_free_.axial * free;
    const double lateral = -by_control_.lateral * control + by_free_.lateral * free;
    return diagonal(std::expm1(axial), std::expm1(lateral), std::expm1(lateral));
  }
  PathStrain strain(const PathState& s) const override {
    const double axial = by_control_.axial * s.control - by_free_.axial * s.free;
    const double lateral = by_control_.lateral * s.control - by_free_.lateral * s.free;
    return {axial, axial + 2 * lateral, 0};
  }

 private:
  Rates by_control_, by_free_;
};

/// F = [[1, g, 0], [0, l, 0], [0, 0, 1]] with l = exp(free).
class ShearMotion final : public Motion {
 public:
  Mat3<double> increment(const PathState& from, const PathState& to) const override {
    Mat3<double> m = zero3<double>();
    m(0, 1) = (to.control - from.control) * std::exp(-from.free);
    m(1, 1) = std::expm1(to.free - from.free);
    return m;
  }
  PathStrain strain(const PathState& s) const override { return {0, -s.free, s.control}; }
};

/// F = I + c (F_end - I), c from 0 to 1.
class GradientMotion final : public Motion {
 public:
  explicit GradientMotion(const std::array<double, 9>& final_gradient) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        change_(i, j) = final_gradient[static_cast<std::size_t>(3 * i + j)] - (i == j ? 1 : 0);
      }
    }
  }
  Mat3<double> increment(const PathState& from, const PathState& to) const override {
    return change_ * (to.control - from.control) * inverse(gradient(from.control));
  }
  PathStrain strain(const PathState& s) const override {
    const Mat3<double> f = gradient(s.control);
    const double stretch = std::sqrt(f(0, 0) * f(0, 0) + f(1, 0) * f(1, 0) + f(2, 0) * f(2, 0));
    return {-std::log(stretch), -std::log(det(f)), f(0, 1)};
  }

 private:
  Mat3<double> gradient(double control) const { return identity3<double>() + change_ * control; }

  Mat3<double> change_;
};

}  // namespace

std::unique_ptr<Motion> confining_motion() {
  return std::make_unique<AxialMotion>(AxialMotion::Rates{0, 0}, AxialMotion::Rates{1, 1});
}

std::unique_ptr<Motion> normal_motion() { return std::make_unique<ShearMotion>(); }

std::unique_ptr<Motion> path_motion(const PathSpec& path, bool water) {
  const auto axial = [](AxialMotion::Rates control, AxialMotion::Rates free) {
    return std::make_unique<AxialMotion>(control, free);
  };
  switch (path.type) {
    case LabTest::isotropic:
      return axial({1.0 / 3, 1.0 / 3}, {0, 0});
    case LabTest::oedometer:
      return axial({1, 0}, {0, 0});
    case LabTest::triaxial_drained:
      return axial({1, 0}, {0, 1});
    case LabTest::triaxial_undrained:
      return water ? axial({1, -0.5}, {0, 1}) : axial({1, -0.5}, {0, 0});
    case LabTest::simple_shear:
      return std::make_unique<ShearMotion>();
    case LabTest::gradient:
      return std::make_unique<GradientMotion>(path.gradient);
  }
  return nullptr;
}

}  // namespace scree
