// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "solver/coupling/pressure_action.hpp"

namespace scree {

/// How a linear solve ended.
struct SolveReport {
  bool converged = false;
  int iterations = 0;
  double residual = 0;  ///< |b - A x| over |b|
  std::string reason;   ///< PETSc's name of it
};

/// The preconditioner where none is asked for. icc needs few iterations, but to set it up takes
/// longer than they do in 3D, where rows are long.
std::string default_preconditioner(int dimension);

/// Options that PETSc does not know, " -name" each, or its sentence about a wrong value; found by a
/// small solve that prints nothing. `options`: of the deck; those of PETSC_OPTIONS are seen too.
/// Options of single levels of a multigrid, which a small solve may not have, are passed over.
std::string wrong_solver_options(const std::string& preconditioner, const std::string& options);

/// Conjugate gradients for the pressure, by PETSc. PETSc starts with the first solver of the
/// process and ends with the process. Any option of PETSc with the prefix `scree_p_` acts on it,
/// from the deck or from the environment variable PETSC_OPTIONS; those of the deck end with the
/// solver.
class PressureSolver {
 public:
  /// preconditioner: a PCType (icc, jacobi, gamg, hypre, ml, ...). options: PETSc's, as text.
  PressureSolver(const std::string& preconditioner, double tolerance, const std::string& options);
  ~PressureSolver();
  PressureSolver(const PressureSolver&) = delete;
  PressureSolver& operator=(const PressureSolver&) = delete;

  /// Whether the preconditioner asks for single entries beside the diagonal. Else a system may be
  /// given by what it does to vectors, set_action().
  bool needs_entries() const;
  /// The coming systems, which may change between solves but keep their rows; must outlive them.
  void set_action(const PressureAction& action);
  /// Solves A x = b for the system of set_action, as below.
  SolveReport solve(const std::vector<double>& b, std::vector<double>& x);

  /// The pattern of the coming systems, in compressed rows.
  void set_pattern(const std::vector<std::int32_t>& row_begin,
                   const std::vector<std::int32_t>& columns);

  /// Solves A x = b from the guess in x; values in the order of the pattern. Throws RunFault where
  /// PETSc itself fails, with its message, and after the first solve UserError for options that
  /// nothing has used.
  SolveReport solve(const std::vector<double>& values, const std::vector<double>& b,
                    std::vector<double>& x);

  /// The same without a look at the options.
  SolveReport try_solve(const std::vector<double>& values, const std::vector<double>& b,
                        std::vector<double>& x);
  /// Options with the prefix that nothing in PETSc has asked for so far, " -name" each.
  std::string unused_options() const;

 private:
  struct State;
  SolveReport run(const std::vector<double>& b, std::vector<double>& x);
  void check_options();
  std::unique_ptr<State> state_;
};

}  // namespace scree
