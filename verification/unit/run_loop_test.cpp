// SPDX-License-Identifier: Apache-2.0
#include "app/run_loop.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <map>

#include "app/recorder.hpp"
#include "app/run_folder.hpp"
#include "solver/base/error.hpp"
#include "solver/io/checkpoint.hpp"
#include "verification/support/fake_simulation.hpp"
#include "verification/support/file_size_limit.hpp"
#include "verification/support/process.hpp"
#include "verification/support/temporary_folder.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

constexpr double stable = 0.0013;  // divides none of the intervals
const RunIdentity identity{"[time]\nend = 1\n", "cpu", "0.1.0"};

Schedule schedule() { return Schedule(1.0, 0.002, 0.1, 0.25); }

OutputSpec output() {
  OutputSpec spec;
  spec.precision = FramePrecision::double_;
  spec.fields = {"pressure"};
  spec.grid = true;
  return spec;
}

/// One call of a run in `path`; `prepare` may bend the simulation or the limits.
RunEnd run(
    const fs::path& path, FolderMode mode, const RunLimits& limits = {},
    const std::function<void(FakeSimulation&)>& prepare = [](FakeSimulation&) {}) {
  const RunFolder folder = RunFolder::open(path, mode);
  FakeSimulation simulation(schedule(), stable, 50);
  prepare(simulation);
  Recorder recorder(folder, output(), true, schedule(), identity);
  if (mode == FolderMode::resume) {
    const CheckpointReader checkpoint(folder.checkpoint());
    check_identity(checkpoint, identity);
    simulation.load(checkpoint);
    recorder.resume(simulation, checkpoint, {});
  } else {
    recorder.start(simulation, {});
  }
  return run_loop(simulation, schedule(), recorder, limits, [] {});
}

/// Relative name -> content of all files.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files[fs::relative(entry.path(), folder).string()] = read_text(entry.path());
    }
  }
  return files;
}

/// The same files with the same bytes.
void expect_same_run(const fs::path& a, const fs::path& b) {
  const auto first = contents(a);
  const auto second = contents(b);
  std::vector<std::string> names_a, names_b;
  for (const auto& [name, text] : first) names_a.push_back(name);
  for (const auto& [name, text] : second) names_b.push_back(name);
  ASSERT_EQ(names_a, names_b);
  for (const auto& [name, text] : first) EXPECT_TRUE(text == second.at(name)) << name;
}

class RunLoopTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(run(whole(), FolderMode::fresh), RunEnd::end_time); }
  fs::path whole() const { return folder_ / "whole"; }
  fs::path part() const { return folder_ / "part"; }

  TemporaryFolder folder_;
};

TEST_F(RunLoopTest, WritesEveryEventOnce) {
  const auto files = contents(whole());
  // 11 frames of particles and grid, their two collections, history, checkpoint
  EXPECT_EQ(files.size(), 11u + 11u + 2u + 1u + 1u);
  EXPECT_TRUE(files.contains("frames/particles_000010.vtu"));
  EXPECT_TRUE(files.contains("frames/grid_000010.vti"));
  const std::string& history = files.at("history.csv");
  EXPECT_EQ(std::count(history.begin(), history.end(), '\n'), 1 + 501);
  EXPECT_NE(files.at("particles.pvd").find("timestep=\"1\""), std::string::npos);
}

/// Steps of 1e-11 s from t = 0 all lie within the 1e-9 of an interval that counts as its event.
TEST_F(RunLoopTest, ShortStepsAtAnEventWriteItOnce) {
  const Schedule coarse(1.0, 0.5, 1.0, 0.25);
  RunLimits limits;
  limits.max_steps = 5;
  for (const FolderMode mode : {FolderMode::fresh, FolderMode::resume}) {
    const RunFolder folder = RunFolder::open(part(), mode);
    FakeSimulation simulation(coarse, 1e-11, 5);
    Recorder recorder(folder, output(), true, coarse, identity);
    if (mode == FolderMode::resume) {
      const CheckpointReader checkpoint(folder.checkpoint());
      simulation.load(checkpoint);
      recorder.resume(simulation, checkpoint, {});
    } else {
      recorder.start(simulation, {});
    }
    run_loop(simulation, coarse, recorder, limits, [] {});
    const auto files = contents(part());
    const std::string& history = files.at("history.csv");
    EXPECT_EQ(std::count(history.begin(), history.end(), '\n'), 1 + 1);  // header, t = 0
    EXPECT_TRUE(files.contains("frames/particles_000000.vtu"));
    EXPECT_FALSE(files.contains("frames/particles_000001.vtu"));
  }
}

TEST_F(RunLoopTest, StepsAndGoesOnBitwise) {
  RunLimits limits;
  limits.max_steps = 333;  // between events
  EXPECT_EQ(run(part(), FolderMode::fresh, limits), RunEnd::max_steps);
  EXPECT_EQ(CheckpointReader(part() / "checkpoint.h5").get_value<std::int64_t>("simulation/steps"),
            333);
  EXPECT_EQ(run(part(), FolderMode::resume, limits), RunEnd::max_steps);
  EXPECT_EQ(run(part(), FolderMode::resume), RunEnd::end_time);
  expect_same_run(whole(), part());
}

TEST_F(RunLoopTest, StopsAfterTheFirstStepThatReachesUntil) {
  RunLimits limits;
  limits.until = 0.4321;
  EXPECT_EQ(run(part(), FolderMode::fresh, limits), RunEnd::until);
  const auto clock = CheckpointReader(part() / "checkpoint.h5").get<double>("simulation/clock");
  EXPECT_GE(clock[0], limits.until);
  EXPECT_LT(clock[0] - clock[1], limits.until);  // the step before was still below
  EXPECT_EQ(run(part(), FolderMode::resume), RunEnd::end_time);
  expect_same_run(whole(), part());
}

TEST_F(RunLoopTest, StopsWhenAskedAndGoesOnBitwise) {
  int steps = 0;
  RunLimits limits;
  limits.stop_asked = [&] { return ++steps > 100; };
  EXPECT_EQ(run(part(), FolderMode::fresh, limits), RunEnd::signal);
  EXPECT_EQ(run(part(), FolderMode::resume), RunEnd::end_time);
  expect_same_run(whole(), part());
}

TEST_F(RunLoopTest, AKilledRunIsReadableAndGoesOnBitwise) {
  for (const std::int64_t last : {250, 555, 700}) {
    fs::remove_all(part());
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      run(part(), FolderMode::fresh, {}, [this, last](FakeSimulation& simulation) {
        simulation.before_step = [this, last](std::int64_t step) {
          // The step after a checkpoint was taken; killed before it is written, the run would have
          // none to go on from.
          if (step != last || !wait_for([this] { return fs::exists(part() / "checkpoint.h5"); })) {
            return;
          }
          raise(SIGKILL);
        };
      });
      _exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    EXPECT_EQ(run(part(), FolderMode::resume), RunEnd::end_time);
    expect_same_run(whole(), part());
  }
}

TEST_F(RunLoopTest, AFaultLeavesTheLastGoodFiles) {
  EXPECT_THROW(run(part(), FolderMode::fresh, {},
                   [](FakeSimulation& simulation) {
                     simulation.before_step = [](std::int64_t step) {
                       if (step == 600) throw RunFault("step 600: particle 7 moved too far");
                     };
                   }),
               RunFault);
  EXPECT_EQ(run(part(), FolderMode::resume), RunEnd::end_time);
  expect_same_run(whole(), part());
}

TEST_F(RunLoopTest, AFullDiskLeavesTheLastGoodFiles) {
  const auto frame = fs::file_size(whole() / "frames/particles_000000.vtu");
  const auto history = fs::file_size(whole() / "history.csv");
  ASSERT_GT(
      history,
      500 + std::max(frame, fs::file_size(
                                whole() /
                                "checkpoint.h5")));  // so that the history is what no longer fits
  try {
    const FileSizeLimit limit(history - 500);
    run(part(), FolderMode::fresh);
    ADD_FAILURE() << "no fault";
  } catch (const RunFault& fault) {
    EXPECT_NE(std::string(fault.what()).find("history.csv: File too large"), std::string::npos);
  }
  EXPECT_EQ(run(part(), FolderMode::resume), RunEnd::end_time);
  expect_same_run(whole(), part());
}

/// With the start of a run unwritten when the simulation fails, the write's fault came first.
TEST_F(RunLoopTest, AFailedWriteComesBeforeALaterFault) {
  const RunFolder folder = RunFolder::open(part(), FolderMode::fresh);
  FakeSimulation simulation(schedule(), stable, 50);
  simulation.before_step = [](std::int64_t) { throw RunFault("step 1: particle 7"); };
  Recorder recorder(folder, output(), true, schedule(), identity);
  std::string fault = "none";
  {
    const FileSizeLimit limit(fs::file_size(whole() / "frames/particles_000000.vtu") / 2);
    recorder.start(simulation, {});
    try {
      run_loop(simulation, schedule(), recorder, {}, [] {});
    } catch (const RunFault& first) {
      fault = first.what();
    }
  }
  EXPECT_EQ(fault, "cannot write " + (part() / "frames/particles_000000.vtu").string() +
                       ": File too large");
  EXPECT_EQ(recorder.kept(), "history.csv (to t = 0 s)");
  EXPECT_EQ(contents(part()).size(), 1u);  // history.csv
}

/// A fault of the simulation leaves every row, frame and checkpoint before it.
TEST_F(RunLoopTest, AllThatCameBeforeAFaultIsWritten) {
  const RunFolder folder = RunFolder::open(part(), FolderMode::fresh);
  FakeSimulation simulation(schedule(), stable, 50);
  // The step after t = 0.5 s, an event of all three kinds.
  simulation.before_step = [&](std::int64_t) {
    if (simulation.time() >= 0.5) throw RunFault("particle 7");
  };
  Recorder recorder(folder, output(), true, schedule(), identity);
  recorder.start(simulation, {});
  EXPECT_THROW(run_loop(simulation, schedule(), recorder, {}, [] {}), RunFault);
  const auto files = contents(part());  // before anything else waits for the thread
  EXPECT_TRUE(files.contains("frames/particles_000005.vtu"));
  EXPECT_TRUE(files.contains("frames/grid_000005.vti"));
  EXPECT_EQ(std::count(files.at("history.csv").begin(), files.at("history.csv").end(), '\n'),
            1 + 251);
  const CheckpointReader checkpoint(part() / "checkpoint.h5");
  EXPECT_EQ(checkpoint.get<double>("simulation/clock").at(0), 0.5);
  EXPECT_EQ(checkpoint.get<double>("run/particles_frame_times").size(), 6u);
  EXPECT_EQ(recorder.kept(),
            "frames/particles_000005.vtu (t = 0.5 s), history.csv (to t = 0.5 s), checkpoint.h5 "
            "(t = 0.5 s)");
}

/// For the thread sanitizer, so without frames: VTK computes ranges in a team of threads that the
/// sanitizer cannot see into.
TEST(RecorderThread, WritesRowsAndCheckpointsWhileStepsGoOn) {
  const TemporaryFolder temporary;
  const RunFolder folder = RunFolder::open(temporary / "run", FolderMode::fresh);
  FakeSimulation simulation(schedule(), stable, 50);
  OutputSpec rows_only;
  rows_only.format = FrameFormat::none;
  Recorder recorder(folder, rows_only, true, schedule(), identity);
  recorder.start(simulation, {});
  EXPECT_EQ(run_loop(simulation, schedule(), recorder, {}, [] {}), RunEnd::end_time);
  EXPECT_EQ(recorder.kept(), "history.csv (to t = 1 s), checkpoint.h5 (t = 1 s)");
  const CheckpointReader checkpoint(folder.checkpoint());
  EXPECT_EQ(checkpoint.get_value<std::int64_t>("simulation/steps"), simulation.step_count());
}

TEST_F(RunLoopTest, ResumeNamesWhatChanged) {
  const CheckpointReader checkpoint(whole() / "checkpoint.h5");
  const auto refusal = [&](RunIdentity other) -> std::string {
    try {
      check_identity(checkpoint, other);
    } catch (const UserError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal(identity), "accepted");
  EXPECT_EQ(refusal({"[time]\nend = 2\n", "cpu", "0.1.0"}), "accepted");
  EXPECT_NE(refusal({"[time]\nend = 0.5\n", "cpu", "0.1.0"})
                .find("time.end = 0.5 (was 1; to stop earlier use --until 0.5)"),
            std::string::npos);
  EXPECT_NE(refusal({"[time]\nend = 1\ncfl = 0.3\n", "cpu", "0.1.0"})
                .find("time.cfl = 0.3 (was not given)"),
            std::string::npos);
  EXPECT_NE(refusal({identity.deck, "cuda", "0.1.0"}).find("--backend cpu"), std::string::npos);
  EXPECT_NE(refusal({identity.deck, "cpu", "9.9.9"}).find("scree 0.1.0"), std::string::npos);
}

TEST_F(RunLoopTest, TellsWhatIsKept) {
  const RunFolder folder = RunFolder::open(folder_ / "kept", FolderMode::fresh);
  FakeSimulation simulation(schedule(), stable, 5);
  Recorder recorder(folder, output(), true, schedule(), identity);
  EXPECT_EQ(recorder.kept(), "nothing");
  recorder.start(simulation, {});
  RunLimits limits;
  limits.until = 0.25;
  run_loop(simulation, schedule(), recorder, limits, [] {});
  EXPECT_EQ(recorder.kept(),
            "frames/particles_000002.vtu (t = 0.2 s), history.csv (to t = 0.25 s), checkpoint.h5 "
            "(t = 0.25 s)");
}

}  // namespace
}  // namespace scree
