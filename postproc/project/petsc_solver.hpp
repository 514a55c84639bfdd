// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "postproc/project/projection_system.hpp"

/// PETSc behind plain types. MPI is started by the first use and ended with the program.
namespace scree {

/// Which process of how many this is; (0, 1) without mpirun.
struct MpiRank {
  int rank = 0, size = 1;
};

/// Starts MPI and PETSc, if they do not run yet. `options` are words as on a PETSc command line.
/// Throws UserError for malformed ones, RunFault where MPI cannot start.
MpiRank start_petsc(const std::vector<std::string>& options);

/// The sum over all processes, on all of them.
double sum_over_ranks(double value);

/// Names of options that were given to start_petsc and that nothing has asked for.
std::vector<std::string> unused_petsc_options();

/// How a linear solve ended.
struct SolveReport {
  bool converged = false;
  std::string reason;  ///< of PETSc, e.g. CONVERGED_RTOL
  int iterations = 0;
  double residual = 0;   ///< |b - A x| / |b|
  std::string sentence;  ///< all of it for people
};

/// What the solver does unless PETSc's options say otherwise.
struct SolverChoice {
  std::string prefix;                     ///< of its PETSc options, e.g. "scree_project_"
  std::string preconditioner = "jacobi";  ///< jacobi, gamg, hypre, ml
  double tolerance = 1e-12;               ///< of the preconditioned residual
  int most_iterations = 10000;
};

/// Conjugate gradients for a symmetric positive matrix of which this process holds some rows.
class SpdSolver {
 public:
  /// Throws RunFault with PETSc's words.
  SpdSolver(const SparseRows& rows, const SolverChoice& choice);
  SpdSolver(const SpdSolver&) = delete;
  SpdSolver& operator=(const SpdSolver&) = delete;
  ~SpdSolver();

  /// Solves A x = b; `b` are this process's rows. Returns all of x on process 0, nothing on the
  /// others. Throws RunFault where PETSc itself fails; not converging is in the report.
  std::vector<double> solve(const std::vector<double>& b, SolveReport& report);

  /// All of a vector of which this process holds its rows; on process 0.
  std::vector<double> gather(const std::vector<double>& part);

  std::string describe() const;  ///< "cg + jacobi, relative tolerance 1e-12"

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// The version of PETSc, e.g. 3.18.5.
std::string petsc_version();

}  // namespace scree
