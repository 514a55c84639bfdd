// SPDX-License-Identifier: Apache-2.0
#include "postproc/project/petsc_solver.hpp"

#include <fmt/format.h>
#include <petscksp.h>

#include <algorithm>
#include <limits>

#include "solver/base/error.hpp"
#include "solver/base/foreign_leaks.hpp"
#include "solver/base/problems.hpp"

namespace scree {
namespace {

static_assert(sizeof(PetscScalar) == sizeof(double), "PETSc must be built for real doubles");

/// The last message of PETSc, kept for the sentence that the user gets.
std::string petsc_message;

PetscErrorCode keep_message(MPI_Comm, int, const char*, const char*, PetscErrorCode code,
                            PetscErrorType type, const char* message, void*) {
  if (type == PETSC_ERROR_INITIAL && message != nullptr) petsc_message = message;
  return code;
}

void check(PetscErrorCode code) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  std::string message =
      petsc_message.empty() ? (text != nullptr ? text : "unknown") : petsc_message;
  petsc_message.clear();
  std::replace(message.begin(), message.end(), '\n', ' ');
  throw RunFault("PETSc failed: " + message);
}

/// MPI and PETSc from the first use to the end of the program.
class Session {
 public:
  Session() {
    // Errors come back as exceptions; signals stay the program's own. A run with pore water may
    // have started PETSc before; then that ends it.
    PetscBool running = PETSC_FALSE;
    PetscInitialized(&running);
    own_ = running == PETSC_FALSE;
    overlook_foreign_leaks();
    if (own_ && PetscInitializeNoArguments() != 0) {
      throw RunFault("PETSc and MPI could not be started");
    }
    if (own_) PetscPopSignalHandler();
    check(PetscPushErrorHandler(&keep_message, nullptr));
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session() {
    if (own_) PetscFinalize();
  }

 private:
  bool own_ = true;
};

void start() { static const Session session; }

std::vector<std::string>& given_options() {
  static std::vector<std::string> names;
  return names;
}

template <class T, PetscErrorCode (*destroy)(T*)>
class Handle {
 public:
  Handle() = default;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { destroy(&value_); }
  operator T() const { return value_; }  // NOLINT: stands for the handle in PETSc's calls
  T* out() { return &value_; }

 private:
  T value_ = nullptr;
};

using MatrixHandle = Handle<Mat, MatDestroy>;
using VectorHandle = Handle<Vec, VecDestroy>;
using SolverHandle = Handle<KSP, KSPDestroy>;
using ScatterHandle = Handle<VecScatter, VecScatterDestroy>;

PetscInt to_petsc(std::int64_t value) {
  if (value > std::numeric_limits<PetscInt>::max()) {
    throw RunFault(
        "the grid has more unknowns or matrix entries than this PETSc can count (2^31); "
        "take a larger spacing or more processes");
  }
  return static_cast<PetscInt>(value);
}

}  // namespace

MpiRank start_petsc(const std::vector<std::string>& options) {
  start();
  for (const std::string& word : options) {
    if (word.size() > 1 && word[0] == '-' && (word[1] < '0' || word[1] > '9') && word[1] != '.') {
      given_options().push_back(word);
    }
  }
  if (!options.empty() && options.front()[0] != '-') {
    throw UserError("PETSc options begin with -, e.g. -scree_project_pc_type gamg; not " +
                    options.front());
  }
  check(PetscOptionsInsertString(nullptr, join(options, " ").c_str()));
  MpiRank rank;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank.rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &rank.size);
  return rank;
}

double sum_over_ranks(double value) {
  double sum = 0;
  MPI_Allreduce(&value, &sum, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return sum;
}

std::vector<std::string> unused_petsc_options() {
  std::vector<std::string> unused;
  for (const std::string& name : given_options()) {
    PetscBool used = PETSC_FALSE;
    check(PetscOptionsUsed(nullptr, name.c_str() + 1, &used));
    if (used == PETSC_FALSE) unused.push_back(name);
  }
  return unused;
}

struct SpdSolver::Parts {
  MatrixHandle matrix;
  VectorHandle b, x, r, all;
  ScatterHandle to_first;
  SolverHandle solver;
};

SpdSolver::SpdSolver(const SparseRows& rows, const SolverChoice& choice)
    : parts_(std::make_unique<Parts>()) {
  start();
  const PetscInt local = to_petsc(rows.rows()), size = to_petsc(rows.size);
  std::vector<PetscInt> start_of(rows.start.size()), column(rows.column.size());
  std::transform(rows.start.begin(), rows.start.end(), start_of.begin(), to_petsc);
  std::transform(rows.column.begin(), rows.column.end(), column.begin(), to_petsc);
  check(MatCreateMPIAIJWithArrays(PETSC_COMM_WORLD, local, local, size, size, start_of.data(),
                                  column.data(), rows.value.data(), parts_->matrix.out()));
  check(MatSetOption(parts_->matrix, MAT_SPD, PETSC_TRUE));
  check(MatCreateVecs(parts_->matrix, parts_->x.out(), parts_->b.out()));
  check(VecDuplicate(parts_->b, parts_->r.out()));
  check(VecScatterCreateToZero(parts_->x, parts_->to_first.out(), parts_->all.out()));

  check(KSPCreate(PETSC_COMM_WORLD, parts_->solver.out()));
  const KSP solver = parts_->solver;
  check(KSPSetOptionsPrefix(solver, choice.prefix.c_str()));
  check(KSPSetOperators(solver, parts_->matrix, parts_->matrix));
  check(KSPSetType(solver, KSPCG));
  check(KSPSetTolerances(solver, choice.tolerance, PETSC_DEFAULT, PETSC_DEFAULT,
                         to_petsc(choice.most_iterations)));
  // The preconditioned residual is near to the error: nodes with little support count as others.
  check(KSPSetNormType(solver, KSP_NORM_PRECONDITIONED));
  PC preconditioner = nullptr;
  check(KSPGetPC(solver, &preconditioner));
  check(PCSetType(preconditioner, choice.preconditioner.c_str()));
  check(KSPSetFromOptions(solver));
  check(KSPSetUp(solver));
}

SpdSolver::~SpdSolver() = default;

std::vector<double> SpdSolver::solve(const std::vector<double>& b, SolveReport& report) {
  const KSP solver = parts_->solver;
  PetscScalar* values = nullptr;
  check(VecGetArray(parts_->b, &values));
  std::copy(b.begin(), b.end(), values);
  check(VecRestoreArray(parts_->b, &values));
  check(VecSet(parts_->x, 0));
  check(KSPSolve(solver, parts_->b, parts_->x));

  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  const char* name = nullptr;
  PetscInt iterations = 0;
  PetscReal residual = 0, size = 0;
  check(KSPGetConvergedReason(solver, &reason));
  check(KSPGetConvergedReasonString(solver, &name));
  check(KSPGetIterationNumber(solver, &iterations));
  check(MatMult(parts_->matrix, parts_->x, parts_->r));
  check(VecAYPX(parts_->r, -1, parts_->b));
  check(VecNorm(parts_->r, NORM_2, &residual));
  check(VecNorm(parts_->b, NORM_2, &size));
  report.converged = reason > 0;
  report.reason = name;
  report.iterations = static_cast<int>(iterations);
  report.residual = size > 0 ? residual / size : residual;
  report.sentence = fmt::format("{} after {} iterations, |r|/|b| = {:.2e}", report.reason,
                                report.iterations, report.residual);
  std::vector<double> part(static_cast<std::size_t>(b.size()));
  const PetscScalar* x = nullptr;
  check(VecGetArrayRead(parts_->x, &x));
  std::copy_n(x, part.size(), part.begin());
  check(VecRestoreArrayRead(parts_->x, &x));
  return gather(part);
}

std::vector<double> SpdSolver::gather(const std::vector<double>& part) {
  PetscScalar* values = nullptr;
  check(VecGetArray(parts_->x, &values));
  std::copy(part.begin(), part.end(), values);
  check(VecRestoreArray(parts_->x, &values));
  check(VecScatterBegin(parts_->to_first, parts_->x, parts_->all, INSERT_VALUES, SCATTER_FORWARD));
  check(VecScatterEnd(parts_->to_first, parts_->x, parts_->all, INSERT_VALUES, SCATTER_FORWARD));
  PetscInt count = 0;
  const PetscScalar* all = nullptr;
  check(VecGetLocalSize(parts_->all, &count));
  check(VecGetArrayRead(parts_->all, &all));
  std::vector<double> result(all, all + count);
  check(VecRestoreArrayRead(parts_->all, &all));
  return result;
}

std::string SpdSolver::describe() const {
  const KSP solver = parts_->solver;
  PC preconditioner = nullptr;
  KSPType type = nullptr;
  PCType pc_type = nullptr;
  PetscReal tolerance = 0;
  check(KSPGetType(solver, &type));
  check(KSPGetPC(solver, &preconditioner));
  check(PCGetType(preconditioner, &pc_type));
  check(KSPGetTolerances(solver, &tolerance, nullptr, nullptr, nullptr));
  return fmt::format("{} + {}, relative tolerance {:g}", type, pc_type, tolerance);
}

std::string petsc_version() {
  return fmt::format("{}.{}.{}", PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR, PETSC_VERSION_SUBMINOR);
}

}  // namespace scree
