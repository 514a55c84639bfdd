// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "solver/base/error.hpp"
#include "solver/coupling/pressure_solver.hpp"
#include "solver/io/checkpoint.hpp"
#include "verification/support/file_size_limit.hpp"
#include "verification/support/temporary_folder.hpp"

namespace scree::testing {
namespace {

/// The chain -1, 3, -1 of n nodes; its solution for a right-hand side of ones is near one.
struct Chain {
  std::vector<std::int32_t> row_begin{0}, columns;
  std::vector<double> values, b, x;

  explicit Chain(int n) : b(std::size_t(n), 1.0), x(std::size_t(n), 0.0) {
    for (int r = 0; r < n; ++r) {
      for (int c = std::max(r - 1, 0); c <= std::min(r + 1, n - 1); ++c) {
        columns.push_back(c);
        values.push_back(c == r ? 3 : -1);
      }
      row_begin.push_back(std::int32_t(columns.size()));
    }
  }
  SolveReport solve(const std::string& options) {
    PressureSolver solver("jacobi", 1e-10, options);
    solver.set_pattern(row_begin, columns);
    std::fill(x.begin(), x.end(), 0.0);
    return solver.solve(values, b, x);
  }
};

TEST(PressureSolver, options_end_with_their_solver) {
  Chain chain(50);
  EXPECT_FALSE(chain.solve("-scree_p_ksp_max_it 1").converged);
  const SolveReport report = chain.solve("");
  EXPECT_TRUE(report.converged);
  EXPECT_GT(report.iterations, 1);
  EXPECT_NEAR(chain.x[25], 1, 1e-9);  // far from the ends, where 3 x - 2 x = 1
}

TEST(PressureSolver, options_of_solvers_side_by_side_are_their_own) {
  Chain chain(50);
  PressureSolver poor("jacobi", 1e-10, "-scree_p_ksp_max_it 1"), good("jacobi", 1e-10, "");
  poor.set_pattern(chain.row_begin, chain.columns);
  good.set_pattern(chain.row_begin, chain.columns);
  EXPECT_TRUE(good.solve(chain.values, chain.b, chain.x).converged);
  std::fill(chain.x.begin(), chain.x.end(), 0.0);
  EXPECT_FALSE(poor.solve(chain.values, chain.b, chain.x).converged);
}

TEST(PressureSolver, unknown_options_end_the_first_solve) {
  Chain chain(5);
  EXPECT_THROW(chain.solve("-scree_p_ksp_rtoll 1e-3"), UserError);
}

TEST(PressureSolver, wrong_options_are_known_before) {
  EXPECT_EQ(wrong_solver_options("icc", ""), "");
  EXPECT_EQ(wrong_solver_options("gamg", "-scree_p_ksp_rtol 1e-3 -scree_p_mg_levels_7_pc_type sor"),
            "");
  EXPECT_EQ(wrong_solver_options("jacobi", "-scree_p_ksp_rtoll 1e-3"),
            "PETSc does not know -scree_p_ksp_rtoll");
  EXPECT_NE(wrong_solver_options("jacobi", "-scree_p_pc_type none_such").find("PETSc failed"),
            std::string::npos);
}

/// A solve, then a checkpoint on a full disk, then the end of the program.
void solve_then_fill_the_disk() {
  Chain chain(50);
  const bool solved = chain.solve("").converged;
  const TemporaryFolder folder;
  bool failed = false;
  try {
    const FileSizeLimit limit(30000);
    CheckpointWriter out(folder / "checkpoint.h5");
    out.put("large", std::vector<double>(100000, 1.0));
    out.commit();
  } catch (const RunFault&) {
    failed = true;
  }
  std::exit(solved && failed ? 1 : 2);
}

TEST(PressureSolverDeathTest, a_full_disk_does_not_disturb_the_end_of_the_program) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // a process in which neither library has begun
  EXPECT_EXIT(solve_then_fill_the_disk(), ::testing::ExitedWithCode(1), "");
}

}  // namespace
}  // namespace scree::testing
