// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace scree {

/// How a linear solve ended.
struct SolveReport {
  bool converged = false;
  int iterations = 0;
  double residual = 0;  ///< |b - A x| over |b|
  std::string reason;   ///< PETSc's name of it
};

/// Conjugate gradients for the pressure, by PETSc. PETSc starts with the first solver of the
/// process and ends with the process. Any option of PETSc with the prefix `scree_p_` acts on it,
/// from the deck or from the environment variable PETSC_OPTIONS.
class PressureSolver {
 public:
  /// preconditioner: a PCType (icc, jacobi, gamg, hypre, ml, ...). options: PETSc's, as text.
  PressureSolver(const std::string& preconditioner, double tolerance, const std::string& options);
  ~PressureSolver();
  PressureSolver(const PressureSolver&) = delete;
  PressureSolver& operator=(const PressureSolver&) = delete;

  /// The pattern of the coming systems, in compressed rows.
  void set_pattern(const std::vector<std::int32_t>& row_begin,
                   const std::vector<std::int32_t>& columns);

  /// Solves A x = b from the guess in x; values in the order of the pattern. Throws RunFault where
  /// PETSc itself fails, with its message.
  SolveReport solve(const std::vector<double>& values, const std::vector<double>& b,
                    std::vector<double>& x);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace scree
