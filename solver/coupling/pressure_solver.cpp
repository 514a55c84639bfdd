// SPDX-License-Identifier: Apache-2.0
#include "solver/coupling/pressure_solver.hpp"

#include <fmt/format.h>
#include <petscksp.h>

#include <algorithm>
#include <cctype>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <sstream>

#include "solver/base/error.hpp"
#include "solver/base/foreign_leaks.hpp"
#include "solver/io/hdf5_handle.hpp"

namespace scree {
namespace {

constexpr const char* prefix = "scree_p_";

/// PETSc serves one thread at a time: runs beside each other in a process (`scree verify`) take
/// turns.
std::recursive_mutex petsc;

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
    // First: a parallel HDF5 that finds MPI running ends with it, in the middle of files that a
    // full disk has left open.
    start_hdf5();
    check(PetscInitializeNoArguments(), "PetscInitialize");
    PetscPopSignalHandler();  // signals are the run's
    PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
    std::atexit(finish_petsc);
  });
}

bool petsc_is_over() {
  PetscBool over = PETSC_FALSE;
  PetscFinalized(&over);
  return over == PETSC_TRUE;
}

/// While it lasts, PETSc serves one solver, and every part of PETSc reads that solver's options.
class Turn {
 public:
  explicit Turn(PetscOptions options) : lock_(petsc), pushed_(options != nullptr) {
    if (pushed_) check(PetscOptionsPush(options), "PetscOptionsPush");
  }
  ~Turn() {
    if (pushed_ && !petsc_is_over()) PetscOptionsPop();
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  std::lock_guard<std::recursive_mutex> lock_;
  bool pushed_;
};

const PressureAction& action_of(Mat matrix) {
  void* context = nullptr;
  MatShellGetContext(matrix, &context);
  return *static_cast<const PressureAction*>(context);
}

PetscErrorCode multiply(Mat matrix, Vec x, Vec y) {
  const PetscScalar* from = nullptr;
  PetscScalar* to = nullptr;
  PetscErrorCode code = VecGetArrayRead(x, &from);
  if (code == 0) code = VecGetArrayWrite(y, &to);
  if (code != 0) return code;
  action_of(matrix).multiply(from, to);
  VecRestoreArrayWrite(y, &to);
  return VecRestoreArrayRead(x, &from);
}

PetscErrorCode get_diagonal(Mat matrix, Vec d) {
  PetscScalar* to = nullptr;
  const PetscErrorCode code = VecGetArrayWrite(d, &to);
  if (code != 0) return code;
  action_of(matrix).diagonal(to);
  return VecRestoreArrayWrite(d, &to);
}

/// The options of the process with those of a deck added.
PetscOptions make_options(const std::string& deck) {
  PetscOptions options = nullptr;
  check(PetscOptionsCreate(&options), "PetscOptionsCreate");
  char* process = nullptr;
  check(PetscOptionsGetAll(nullptr, &process), "PetscOptionsGetAll");
  const std::string both = std::string(process) + " " + deck;
  PetscFree(process);
  check(PetscOptionsInsertString(options, both.c_str()), "PetscOptionsInsertString");
  return options;
}

}  // namespace

struct PressureSolver::State {
  PetscOptions options = nullptr;
  KSP ksp = nullptr;
  // The matrix in compressed rows; PETSc works on these arrays.
  std::vector<PetscInt> row_begin, columns;
  std::vector<PetscScalar> values;
  Mat matrix = nullptr;
  Vec b = nullptr, x = nullptr;
  bool set_up = false;
  bool options_used = false;  ///< it is known that PETSc has used all of them

  ~State() {
    if (petsc_is_over()) return;  // at the end of the process PETSc has freed all
    {
      const Turn turn(options);
      destroy_system();
      if (ksp != nullptr) KSPDestroy(&ksp);
    }
    if (options != nullptr) PetscOptionsDestroy(&options);
  }

  void destroy_system() {
    if (matrix != nullptr) MatDestroy(&matrix);
    if (b != nullptr) VecDestroy(&b);
    if (x != nullptr) VecDestroy(&x);
  }

  /// Vectors for the matrix; what the preconditioner knew of the one before is forgotten.
  void start_system(PetscInt n) {
    check(MatSetOption(matrix, MAT_SPD, PETSC_TRUE), "MatSetOption");
    check(VecCreateSeq(PETSC_COMM_SELF, n, &b), "VecCreate");
    check(VecDuplicate(b, &x), "VecDuplicate");
    if (set_up) check(KSPReset(ksp), "KSPReset");
    set_up = false;
  }
};

PressureSolver::PressureSolver(const std::string& preconditioner, double tolerance,
                               const std::string& options)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  {
    const Turn turn(nullptr);
    start_petsc();
    s.options = make_options(options);
  }
  const Turn turn(s.options);
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
  State& s = *state_;
  const Turn turn(s.options);
  s.destroy_system();
  const PetscInt n = PetscInt(row_begin.size()) - 1;
  s.row_begin.assign(row_begin.begin(), row_begin.end());
  s.columns.assign(columns.begin(), columns.end());
  s.values.assign(columns.size(), 0.0);
  check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, n, n, s.row_begin.data(), s.columns.data(),
                                  s.values.data(), &s.matrix),
        "MatCreateSeqAIJWithArrays");
  s.start_system(n);
}

bool PressureSolver::needs_entries() const {
  const Turn turn(state_->options);
  PC pc = nullptr;
  check(KSPGetPC(state_->ksp, &pc), "KSPGetPC");
  PetscBool jacobi = PETSC_FALSE, none = PETSC_FALSE;
  check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(pc), PCJACOBI, &jacobi), "PCGetType");
  check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(pc), PCNONE, &none), "PCGetType");
  PCJacobiType type = PC_JACOBI_DIAGONAL;
  if (jacobi == PETSC_TRUE) check(PCJacobiGetType(pc, &type), "PCJacobiGetType");
  return none == PETSC_FALSE && (jacobi == PETSC_FALSE || type != PC_JACOBI_DIAGONAL);
}

void PressureSolver::set_action(const PressureAction& action) {
  State& s = *state_;
  const Turn turn(s.options);
  s.destroy_system();
  const PetscInt n = action.rows();
  // PETSc hands the pointer back as it is; nothing is written through it.
  void* context = const_cast<PressureAction*>(&action);  // NOLINT(*-const-cast)
  check(MatCreateShell(PETSC_COMM_SELF, n, n, n, n, context, &s.matrix), "MatCreateShell");
  using Operation = void (*)();
  for (const MatOperation product : {MATOP_MULT, MATOP_MULT_TRANSPOSE}) {
    check(MatShellSetOperation(s.matrix, product, reinterpret_cast<Operation>(multiply)),
          "MatShellSetOperation");
  }
  check(
      MatShellSetOperation(s.matrix, MATOP_GET_DIAGONAL, reinterpret_cast<Operation>(get_diagonal)),
      "MatShellSetOperation");
  s.start_system(n);
}

std::string PressureSolver::unused_options() const {
  PetscInt count = 0;
  char** names = nullptr;
  char** values = nullptr;
  const Turn turn(nullptr);
  check(PetscOptionsLeftGet(state_->options, &count, &names, &values), "PetscOptionsLeftGet");
  std::string unused;
  for (PetscInt i = 0; i < count; ++i) {
    if (std::string(names[i]).starts_with(prefix)) unused += std::string(" -") + names[i];
  }
  PetscOptionsLeftRestore(state_->options, &count, &names, &values);
  return unused;
}

SolveReport PressureSolver::try_solve(const std::vector<double>& values,
                                      const std::vector<double>& b, std::vector<double>& x) {
  State& s = *state_;
  const Turn turn(s.options);
  PetscScalar* entries = nullptr;
  check(MatSeqAIJGetArrayWrite(s.matrix, &entries), "MatSeqAIJGetArrayWrite");
  std::copy(values.begin(), values.end(), entries);
  check(MatSeqAIJRestoreArrayWrite(s.matrix, &entries), "MatSeqAIJRestoreArrayWrite");
  return run(b, x);
}

/// The solve itself, of the matrix as it is.
SolveReport PressureSolver::run(const std::vector<double>& b, std::vector<double>& x) {
  State& s = *state_;
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
  return report;
}

SolveReport PressureSolver::solve(const std::vector<double>& values, const std::vector<double>& b,
                                  std::vector<double>& x) {
  const SolveReport report = try_solve(values, b, x);
  check_options();
  return report;
}

SolveReport PressureSolver::solve(const std::vector<double>& b, std::vector<double>& x) {
  State& s = *state_;
  SolveReport report;
  {
    const Turn turn(s.options);
    // Says that the matrix has changed.
    check(MatAssemblyBegin(s.matrix, MAT_FINAL_ASSEMBLY), "MatAssemblyBegin");
    check(MatAssemblyEnd(s.matrix, MAT_FINAL_ASSEMBLY), "MatAssemblyEnd");
    report = run(b, x);
  }
  check_options();
  return report;
}

/// After the first solve: options that nothing in PETSc has asked for.
void PressureSolver::check_options() {
  State& s = *state_;
  if (!s.options_used) {
    const std::string unused = unused_options();
    if (!unused.empty()) {
      throw UserError("coupling.solver_options (or PETSC_OPTIONS): PETSc does not use" + unused +
                      "; correct or remove it");
    }
  }
  s.options_used = true;
}

std::string default_preconditioner(int dimension) { return dimension == 2 ? "icc" : "jacobi"; }

namespace {

PetscErrorCode print_nothing(FILE*, const char*, va_list) { return 0; }

/// Keeps monitors and views silent.
class Silence {
 public:
  Silence() : before_(PetscVFPrintf) { PetscVFPrintf = print_nothing; }
  ~Silence() { PetscVFPrintf = before_; }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  decltype(PetscVFPrintf) before_;
};

/// The five-point stencil on n x n nodes, in compressed rows.
void five_points(int n, std::vector<std::int32_t>& row_begin, std::vector<std::int32_t>& columns,
                 std::vector<double>& values) {
  row_begin.assign(1, 0);
  for (int r = 0; r < n * n; ++r) {
    const auto add = [&](bool there, int column, double value) {
      if (!there) return;
      columns.push_back(column);
      values.push_back(value);
    };
    add(r >= n, r - n, -1);
    add(r % n > 0, r - 1, -1);
    add(true, r, 4);
    add(r % n + 1 < n, r + 1, -1);
    add(r + n < n * n, r + n, -1);
    row_begin.push_back(std::int32_t(columns.size()));
  }
}

/// " -scree_p_mg_levels_2_...": of one level.
bool of_one_level(const std::string& option) {
  const std::string start = std::string("-") + prefix + "mg_levels_";
  return option.starts_with(start) && option.size() > start.size() &&
         std::isdigit(option[start.size()]) != 0;
}

}  // namespace

std::string wrong_solver_options(const std::string& preconditioner, const std::string& options) {
  const char* process = std::getenv("PETSC_OPTIONS");
  const bool any = process != nullptr && std::string(process).find(prefix) != std::string::npos;
  if (options.empty() && !any) return "";
  const Turn turn(nullptr);  // of the whole trial
  const Silence silence;
  std::vector<std::int32_t> row_begin, columns;
  std::vector<double> values;
  constexpr int nodes = 40;
  five_points(nodes, row_begin, columns, values);
  std::vector<double> b(std::size_t(nodes) * nodes, 1.0), x(b.size(), 0.0);
  try {
    PressureSolver solver(preconditioner, 1e-8, options);
    solver.set_pattern(row_begin, columns);
    solver.try_solve(values, b, x);
    std::istringstream unused(solver.unused_options());
    std::string wrong, option;
    while (unused >> option) {
      if (!of_one_level(option)) wrong += " " + option;
    }
    return wrong.empty() ? "" : "PETSc does not know" + wrong;
  } catch (const RunFault& fault) {
    return fault.what();
  }
}

}  // namespace scree
