// SPDX-License-Identifier: Apache-2.0
#include "solver/coupling/pressure_solver.hpp"

#include <fmt/format.h>
#include <petscksp.h>

#include <cmath>
#include <cstdlib>
#include <mutex>

#include "solver/base/error.hpp"
#include "solver/base/foreign_leaks.hpp"

namespace scree {
namespace {

constexpr const char* prefix = "scree_p_";

/// PETSc serves one thread at a time: runs beside each other in a process (`scree verify`) take
/// turns.
std::mutex petsc;

/// The sentence of PETSc's last error; its handler is told to be silent.
void check(PetscErrorCode code, const char* what) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw RunFault(fmt::format("the pressure solver: PETSc failed in {}: {} (error {})", what,
                             text != nullptr ? text : "unknown error", int(code)));
}

void finish_petsc() {
  PetscBool running = PETSC_FALSE;
  PetscInitialized(&running);
  if (running == PETSC_TRUE) PetscFinalize();
}

/// Starts PETSc (and MPI) once; whoever has started it before keeps it.
void start_petsc() {
  static std::once_flag once;
  std::call_once(once, [] {
    PetscBool running = PETSC_FALSE;
    PetscInitialized(&running);
    if (running == PETSC_TRUE) return;
    overlook_foreign_leaks();
    check(PetscInitializeNoArguments(), "PetscInitialize");
    PetscPopSignalHandler();  // signals are the run's
    PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
    std::atexit(finish_petsc);
  });
}

/// Options that nothing in PETSc has asked for are mistakes.
void refuse_unused_options() {
  PetscInt count = 0;
  char** names = nullptr;
  char** values = nullptr;
  check(PetscOptionsLeftGet(nullptr, &count, &names, &values), "PetscOptionsLeftGet");
  std::string unused;
  for (PetscInt i = 0; i < count; ++i) {
    if (std::string(names[i]).starts_with(prefix)) unused += std::string(" -") + names[i];
  }
  PetscOptionsLeftRestore(nullptr, &count, &names, &values);
  if (unused.empty()) return;
  throw UserError("coupling.solver_options (or PETSC_OPTIONS): PETSc does not use" + unused +
                  "; correct or remove it");
}

}  // namespace

struct PressureSolver::State {
  KSP ksp = nullptr;
  Mat matrix = nullptr;
  Vec b = nullptr, x = nullptr;
  bool set_up = false;
  bool options_used = false;  ///< it is known that PETSc has used all of them

  ~State() {
    const std::lock_guard turn(petsc);
    destroy(true);
  }

  void destroy(bool solver) {
    PetscBool over = PETSC_FALSE;
    PetscFinalized(&over);
    if (over == PETSC_TRUE) return;  // at the end of the process PETSc has freed all
    if (matrix != nullptr) MatDestroy(&matrix);
    if (b != nullptr) VecDestroy(&b);
    if (x != nullptr) VecDestroy(&x);
    if (solver && ksp != nullptr) KSPDestroy(&ksp);
  }
};

PressureSolver::PressureSolver(const std::string& preconditioner, double tolerance,
                               const std::string& options)
    : state_(std::make_unique<State>()) {
  const std::lock_guard turn(petsc);
  start_petsc();
  State& s = *state_;
  if (!options.empty()) {
    check(PetscOptionsInsertString(nullptr, options.c_str()), "PetscOptionsInsertString");
  }
  check(KSPCreate(PETSC_COMM_SELF, &s.ksp), "KSPCreate");
  check(KSPSetOptionsPrefix(s.ksp, prefix), "KSPSetOptionsPrefix");
  check(KSPSetType(s.ksp, KSPCG), "KSPSetType");
  PC pc = nullptr;
  check(KSPGetPC(s.ksp, &pc), "KSPGetPC");
  check(PCSetType(pc, preconditioner.c_str()), "PCSetType");
  check(KSPSetTolerances(s.ksp, tolerance, 1e-300, PETSC_DEFAULT, 10000), "KSPSetTolerances");
  // The residual itself is measured: a preconditioner may make a poor solution look good.
  check(KSPSetNormType(s.ksp, KSP_NORM_UNPRECONDITIONED), "KSPSetNormType");
  check(KSPSetInitialGuessNonzero(s.ksp, PETSC_TRUE), "KSPSetInitialGuessNonzero");
  check(KSPSetFromOptions(s.ksp), "KSPSetFromOptions");
}

PressureSolver::~PressureSolver() = default;

void PressureSolver::set_pattern(const std::vector<std::int32_t>& row_begin,
                                 const std::vector<std::int32_t>& columns) {
  const std::lock_guard turn(petsc);
  State& s = *state_;
  s.destroy(false);
  const PetscInt n = PetscInt(row_begin.size()) - 1;
  std::vector<PetscInt> rows(columns.size()), cols(columns.begin(), columns.end());
  for (PetscInt r = 0; r < n; ++r) {
    for (std::int32_t i = row_begin[std::size_t(r)]; i < row_begin[std::size_t(r) + 1]; ++i) {
      rows[std::size_t(i)] = r;
    }
  }
  check(MatCreate(PETSC_COMM_SELF, &s.matrix), "MatCreate");
  check(MatSetSizes(s.matrix, n, n, n, n), "MatSetSizes");
  check(MatSetType(s.matrix, MATSEQAIJ), "MatSetType");
  check(MatSetPreallocationCOO(s.matrix, PetscCount(columns.size()), rows.data(), cols.data()),
        "MatSetPreallocationCOO");
  check(MatSetOption(s.matrix, MAT_SPD, PETSC_TRUE), "MatSetOption");
  check(VecCreateSeq(PETSC_COMM_SELF, n, &s.b), "VecCreate");
  check(VecDuplicate(s.b, &s.x), "VecDuplicate");
  if (s.set_up) check(KSPReset(s.ksp), "KSPReset");
  s.set_up = false;
}

SolveReport PressureSolver::solve(const std::vector<double>& values, const std::vector<double>& b,
                                  std::vector<double>& x) {
  const std::lock_guard turn(petsc);
  State& s = *state_;
  check(MatSetValuesCOO(s.matrix, values.data(), INSERT_VALUES), "MatSetValuesCOO");
  check(VecPlaceArray(s.b, b.data()), "VecPlaceArray");
  check(VecPlaceArray(s.x, x.data()), "VecPlaceArray");
  check(KSPSetOperators(s.ksp, s.matrix, s.matrix), "KSPSetOperators");
  const PetscErrorCode code = KSPSolve(s.ksp, s.b, s.x);
  SolveReport report;
  double residual = 0, size = 0;
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  if (code == 0) {
    PetscInt iterations = 0;
    KSPGetIterationNumber(s.ksp, &iterations);
    KSPGetResidualNorm(s.ksp, &residual);
    KSPGetConvergedReason(s.ksp, &reason);
    VecNorm(s.b, NORM_2, &size);
    report.iterations = int(iterations);
    report.residual = size > 0 ? residual / size : residual;
    report.converged = reason > 0;
    report.reason = KSPConvergedReasons[reason];
  }
  VecResetArray(s.b);
  VecResetArray(s.x);
  check(code, "KSPSolve");
  s.set_up = true;
  if (!s.options_used) refuse_unused_options();
  s.options_used = true;
  return report;
}

}  // namespace scree
