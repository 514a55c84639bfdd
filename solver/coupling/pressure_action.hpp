// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace scree {

/// A symmetric matrix that is known by what it does to vectors.
class PressureAction {
 public:
  PressureAction() = default;
  PressureAction(const PressureAction&) = delete;
  PressureAction& operator=(const PressureAction&) = delete;
  virtual ~PressureAction() = default;

  virtual int rows() const = 0;
  /// y = A x.
  virtual void multiply(const double* x, double* y) const = 0;
  virtual void diagonal(double* d) const = 0;
};

}  // namespace scree
