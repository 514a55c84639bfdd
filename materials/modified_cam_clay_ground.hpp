// SPDX-License-Identifier: Apache-2.0
/// \file
/// Ground of ModifiedCamClay at the start; included by modified_cam_clay.hpp.
#pragma once

#include <cstdio>

#include "materials/modified_cam_clay.hpp"

namespace scree {

/// One-dimensional compression at a constant ratio eta = q/p: the volume strain lambda dp/(v p) is
/// 3/2 of the shear strain, whose elastic part is eta dp/(3 G) and whose plastic part follows the
/// flow rule. With L = (lambda - kappa)/lambda that is
///
///     eta (1 + nu)(1 - L)/(3 (1 - 2 nu)) + 3 eta L/(M^2 - eta^2) = 1,
///
/// the left side of which grows from 0 to infinity between 0 and M.
inline double ModifiedCamClay::rest_ratio(const Input& in) {
  const double plastic = (in.lambda - in.kappa) / in.lambda, nu = in.poissons_ratio;
  const double elastic = (1 + nu) * (1 - plastic) / (3 * (1 - 2 * nu));
  double lower = 0, upper = in.m;
  for (int i = 0; i < 60; ++i) {  // the digits of a double, and some more
    const double eta = 0.5 * (lower + upper);
    const double strain = eta * elastic + 3 * eta * plastic / (in.m * in.m - eta * eta);
    (strain < 1 ? lower : upper) = eta;
  }
  return (3 - lower) / (3 + 2 * lower);
}

inline std::optional<ModifiedCamClay::State<double>> ModifiedCamClay::state_under(
    const Input& in, const std::array<double, 3>& stress) {
  const double p = -(stress[0] + stress[1] + stress[2]) / 3;
  if (!(p > 0)) return std::nullopt;
  const Sym3<double> deviator{stress[0] + p, 0, 0, stress[1] + p, 0, stress[2] + p};
  const double q = std::sqrt(1.5) * norm(deviator);
  const double yielding = p + q * q / (in.m * in.m * p);  // pc of the surface through the stress
  const double pc = in.ocr ? *in.ocr * yielding : preconsolidation(in);
  if (yielding > pc) return std::nullopt;
  const double v = specific_volume(in, pc, p);
  if (!(v > 1)) return std::nullopt;
  const double log_v = std::log(v / specific_volume(in));
  return State<double>{deviator * (1 / pc), log_v, std::log(pc / preconsolidation(in)), 0, 0};
}

inline std::string ModifiedCamClay::stress_repair(const Input& in) {
  if (in.ocr) return "raise reference_void_ratio, for no voids would be left";
  return "raise preconsolidation_pressure, or give ocr, which holds at every depth";
}

inline std::string ModifiedCamClay::averaging_doubt(const Input& in, bool stressed) {
  if (stressed && !in.ocr) return "";
  const double ratio = in.ocr ? *in.ocr : preconsolidation(in) / in.initial_pressure;
  if (!(ratio > 2)) return "";
  char text[96];
  std::snprintf(text, sizeof text, "is overconsolidated %.5g times, and above 2 clay dilates",
                ratio);
  return text;
}

}  // namespace scree
