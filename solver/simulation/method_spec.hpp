// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "solver/base/schema.hpp"
#include "solver/simulation/method.hpp"
#include "solver/simulation/volumetric_locking.hpp"

namespace scree {

/// `method.damping`: zero value means none.
struct DampingSpec {
  DampingType type = DampingType::local;
  double value = 0;  ///< local: fraction of the out-of-balance force in [0, 1); mass: 1/s
};

/// `[method]`: the numerical method and what acts on everything.
struct MethodSpec {
  KernelType kernel = KernelType::compact;
  TransferType transfer = TransferType::mls;
  Precision precision = Precision::double_;
  std::array<Formula, 3> gravity{};  ///< m/s^2, of t
  std::array<Formula, 3>
      body_force{};  ///< m/s^2, of X, Y, Z (reference), x, y, z, t; not given: none
  DampingSpec damping;
  VolumetricLocking volumetric_locking = VolumetricLocking::none;
  double flip_blend = 0.95;    ///< flip only: share of the increment, the rest is pic
  bool deterministic = false;  ///< the same bits in every run, on a GPU too
};

const Schema<DampingSpec>& damping_schema();
const Schema<MethodSpec>& method_schema();

}  // namespace scree
