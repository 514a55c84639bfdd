// SPDX-License-Identifier: Apache-2.0
#include "solver/boundary/traction.hpp"

#include <cmath>
#include <string>

#include "solver/base/error.hpp"

namespace scree {

Traction::Traction(const TractionSpec& spec, int dimension)
    : name_(spec.name), follows_(spec.pressure.given()) {
  const std::vector<std::string> variables{"x", "y", "z", "X", "Y", "Z", "t"};
  if (follows_) {
    load_.emplace_back(spec.pressure.text, variables);
    return;
  }
  for (int a = 0; a < dimension; ++a) load_.emplace_back(spec.value[a].text, variables);
}

double Traction::load(std::size_t i, const double values[7]) const {
  const double result = load_[i](values);
  if (!std::isfinite(result))
    throw RunFault("traction." + name_ + ": " + load_[i].text() + " is not finite at (" +
                   std::to_string(values[0]) + ", " + std::to_string(values[1]) + ", " +
                   std::to_string(values[2]) + ") m, t = " + std::to_string(values[6]) + " s");
  return result;
}

Vec3<double> Traction::force(double t, const Vec3<double>& x, const Vec3<double>& start,
                             const Vec3<double>& area_vector, double area,
                             const Mat3<double>& F) const {
  const double values[7] = {x[0], x[1], x[2], start[0], start[1], start[2], t};
  if (follows_) return (cofactor(F) * area_vector) * -load(0, values);
  Vec3<double> f{};
  for (std::size_t a = 0; a < load_.size(); ++a) f[static_cast<int>(a)] = load(a, values) * area;
  return f;
}

}  // namespace scree
