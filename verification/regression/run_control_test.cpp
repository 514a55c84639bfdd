// SPDX-License-Identifier: Apache-2.0
// The program as a user runs it: files, exit statuses, interruptions, continuation.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mount.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "verification/support/file_size_limit.hpp"
#include "verification/support/process.hpp"
#include "verification/support/temporary_folder.hpp"

#ifdef SCREE_EXECUTABLE

namespace scree {
namespace {

namespace fs = std::filesystem;

/// A soft block that falls and bounces: about 600 steps.
constexpr const char* deck_text = R"(title = "Block"
[domain]
dimension = 2
lower = [0.0, 0.0]
upper = [0.4, 0.4]
cell_size = "2 cm"
[time]
end = "0.1 s"
[method]
gravity = [0.0, -9.81]
[material.rubber]
model = "fixed_corotated"
density = 1000
youngs_modulus = "1 MPa"
poissons_ratio = 0.3
[body.block]
material = "rubber"
shape = { type = "box", lower = [0.1, 0.01], upper = [0.3, 0.2] }
velocity = [0.3, -1.0]
[boundary]
x_min = "slip"
x_max = "slip"
y_min = { type = "friction", coefficient = 0.3 }
y_max = "slip"
[output]
every = "10 ms"
precision = "double"
fields = ["velocity", "stress"]
grid = true
[history]
every = "1 ms"
[checkpoint]
every = "25 ms"
)";

class RunControl : public testing::Test {
 protected:
  RunControl() { write_text(deck(), deck_text); }

  fs::path deck() const { return folder_ / "block.toml"; }
  fs::path path(const std::string& name) const { return folder_ / name; }

  std::vector<std::string> command(const std::string& run,
                                   std::vector<std::string> more = {}) const {
    std::vector<std::string> words = {
        SCREE_EXECUTABLE, "run", deck().string(), "-o", path(run).string(), "--threads", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  ProcessResult scree(const std::string& run, const std::vector<std::string>& more = {}) const {
    return run_process(command(run, more));
  }
  nlohmann::json record(const std::string& run) const {
    return nlohmann::json::parse(read_text(path(run) / "run.json"));
  }

  /// Sends the signal when the history has some rows.
  ProcessResult interrupted(const std::string& run, int signal, std::size_t bytes) const {
    return run_process(
        command(run), [] {},
        [&](pid_t child) {
          EXPECT_TRUE(wait_for([&] {
            std::error_code error;
            const auto size = fs::file_size(path(run) / "history.csv", error);
            return !error && size > bytes;
          }));
          kill(child, signal);
        });
  }

  /// All files of a run that must not depend on how often it was stopped.
  std::map<std::string, std::string> results(const std::string& run) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(path(run))) {
      const std::string name = fs::relative(entry.path(), path(run)).string();
      if (entry.is_regular_file() && name != "run.json") files[name] = read_text(entry.path());
    }
    return files;
  }
  void expect_same(const std::string& a, const std::string& b) const {
    const auto first = results(a);
    const auto second = results(b);
    EXPECT_EQ(first.size(), second.size());
    for (const auto& [name, text] : first) {
      EXPECT_TRUE(second.contains(name) && second.at(name) == text) << name;
    }
  }

  TemporaryFolder folder_;
};

TEST_F(RunControl, ARunLeavesTheFilesOfTheContract) {
  const ProcessResult result = scree("a");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const auto files = results("a");
  for (const char* name :
       {"resolved.toml", "history.csv", "particles.pvd", "grid.pvd", "checkpoint.h5",
        "frames/particles_000000.vtu", "frames/particles_000010.vtu"}) {
    EXPECT_TRUE(files.contains(name)) << name;
  }
  for (const auto& [name, text] : files) EXPECT_FALSE(name.ends_with(".tmp")) << name;
  const std::string& history = files.at("history.csv");
  EXPECT_EQ(std::count(history.begin(), history.end(), '\n'), 1 + 101);  // t = 0, 1, ... 100 ms
  const auto json = record("a");
  EXPECT_EQ(json["status"], "done");
  EXPECT_EQ(json["simulated_time"], 0.1);
  EXPECT_GT(json["steps"], 100);  // at most 1 ms each
  EXPECT_GT(json["particle_updates_per_second"], 0.0);
  EXPECT_FALSE(json["cite"].empty());
  EXPECT_NE(result.out.find("please cite"), std::string::npos);
}

TEST_F(RunControl, TheResolvedDeckGivesTheSameRun) {
  ASSERT_EQ(scree("a").status, 0);
  fs::copy_file(path("a") / "resolved.toml", deck(), fs::copy_options::overwrite_existing);
  const ProcessResult result = scree("b");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(read_text(path("a") / "history.csv"), read_text(path("b") / "history.csv"));
}

TEST_F(RunControl, AnExistingRunIsRefusedAndKept) {
  ASSERT_EQ(scree("a", {"--quiet", "--until", "0.01"}).status, 0);
  const auto before = results("a");
  const ProcessResult result = scree("a");
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("--overwrite"), std::string::npos);
  EXPECT_EQ(results("a"), before);
  EXPECT_EQ(scree("a", {"--overwrite"}).status, 0);
}

TEST_F(RunControl, QuietSaysNothingButErrors) {
  const ProcessResult result = scree("a", {"--quiet", "--until", "0.01"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "");
  EXPECT_NE(scree("a", {"--quiet"}).err, "");
}

TEST_F(RunControl, AWrongDeckWritesNothing) {
  const ProcessResult result = scree("a", {"--set", "time.end=-1"});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("time.end"), std::string::npos) << result.err;
  EXPECT_FALSE(fs::exists(path("a")));
}

/// The message about an unknown field lists names; a run must take every one of them.
TEST_F(RunControl, EveryFieldThatTheMessageAllowsIsTaken) {
  const std::string message = scree("a", {"--set", "output.fields=[\"nothing\"]"}).err;
  const std::string phrase = "allowed: ";
  const std::size_t at = message.find(phrase);
  ASSERT_NE(at, std::string::npos) << message;
  const std::size_t begin = at + phrase.size();
  std::string names = message.substr(begin, message.find(';', begin) - begin);
  for (std::size_t i = 0; (i = names.find(", ", i)) != std::string::npos;) {
    names.replace(i, 2, "\",\"");
  }
  const std::string fields = "output.fields=[\"" + names + "\"]";
  for (const char* always : {"id", "material", "body"}) {
    EXPECT_NE(fields.find("\"" + std::string(always) + "\""), std::string::npos) << fields;
  }
  const ProcessResult result = scree("a", {"--max-steps", "2", "--set", fields});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(record("a")["status"], "interrupted");
  const std::string frame = read_text(path("a") / "frames/particles_000000.vtu");
  const std::size_t first = frame.find("Name=\"id\"");
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(frame.find("Name=\"id\"", first + 1), std::string::npos);  // not twice
  EXPECT_NE(frame.find("Name=\"displacement\""), std::string::npos);
}

TEST_F(RunControl, AStepThatNeverEndsIsAFaultAndFillsNoDisk) {
  const ProcessResult result = scree(
      "a", {"--set", "collider.p.shape={type=\"box\",lower=[0,0.3],upper=[0.1,0.35]}", "--set",
            "collider.p.velocity=[\"1/(0.0305-t)\", 0]", "--set", "collider.p.contact=\"slip\""});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("warning: at t = "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("because of collider p, which moves at"), std::string::npos)
      << result.err;
  EXPECT_EQ(record("a")["status"], "failed");
  const std::string history = read_text(path("a") / "history.csv");
  EXPECT_EQ(std::count(history.begin(), history.end(), '\n'), 1 + 31);  // 0, 1, ... 30 ms
}

TEST_F(RunControl, LimitsAndResumeAreBitwise) {
  ASSERT_EQ(scree("whole").status, 0);
  ASSERT_EQ(scree("part", {"--max-steps", "77"}).status, 0);
  EXPECT_EQ(record("part")["steps"], 77);
  EXPECT_EQ(record("part")["status"], "interrupted");
  ASSERT_EQ(scree("part", {"--resume", "--until", "0.0437"}).status, 0);
  EXPECT_GE(record("part")["simulated_time"], 0.0437);
  ASSERT_EQ(scree("part", {"--resume"}).status, 0);
  EXPECT_EQ(record("part")["status"], "done");
  expect_same("whole", "part");
}

TEST_F(RunControl, SignalsWriteACheckpoint) {
  ASSERT_EQ(scree("whole").status, 0);
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string run = "signal" + std::to_string(signal);
    const ProcessResult result = interrupted(run, signal, 2000);
    EXPECT_EQ(result.status, 128 + signal) << result.err;
    EXPECT_EQ(record(run)["status"], "interrupted");
    ASSERT_EQ(scree(run, {"--resume"}).status, 0);
    expect_same("whole", run);
  }
}

TEST_F(RunControl, AKilledRunGoesOn) {
  ASSERT_EQ(scree("whole").status, 0);
  const auto half = fs::file_size(path("whole") / "history.csv") / 2;
  EXPECT_EQ(interrupted("killed", SIGKILL, half).status, 128 + SIGKILL);
  EXPECT_EQ(record("killed")["status"], "running");
  const ProcessResult result = scree("killed", {"--resume"});
  ASSERT_EQ(result.status, 0) << result.err;
  expect_same("whole", "killed");
}

TEST_F(RunControl, ResumeWithAnotherDeckNamesTheKey) {
  ASSERT_EQ(scree("a", {"--until", "0.01"}).status, 0);
  const auto before = results("a");
  const ProcessResult result = scree("a", {"--resume", "--set", "material.rubber.density=1100"});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("material.rubber.density"), std::string::npos) << result.err;
  EXPECT_EQ(results("a"), before);
}

TEST_F(RunControl, ResumeNeedsACheckpoint) {
  const ProcessResult result = scree("a", {"--resume"});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("checkpoint.h5"), std::string::npos);
  EXPECT_FALSE(fs::exists(path("a")));
}

TEST_F(RunControl, ADamagedCheckpointIsOneSentence) {
  ASSERT_EQ(scree("a", {"--until", "0.01"}).status, 0);
  const std::string whole = read_text(path("a") / "checkpoint.h5");
  write_text(path("a") / "checkpoint.h5", whole.substr(0, whole.size() / 2));
  const ProcessResult result = scree("a", {"--resume"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("truncated"), std::string::npos) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1);
}

TEST_F(RunControl, ImpossibleFoldersAreTheUsersMistake) {
  for (const char* run : {"block.toml", "block.toml/run", "/proc/run"}) {
    const ProcessResult result = scree(run);
    EXPECT_EQ(result.status, 2) << run;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

TEST_F(RunControl, AFullFileIsOneSentenceAndTheRunGoesOnLater) {
  ASSERT_EQ(scree("whole").status, 0);
  const auto frame = fs::file_size(path("whole") / "frames/particles_000010.vtu");
  const ProcessResult result =
      run_process(command("full"), [frame] { FileSizeLimit::impose(frame / 2); });
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("cannot write"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("File too large"), std::string::npos) << result.err;
  EXPECT_EQ(record("full")["status"], "failed");
  EXPECT_EQ(record("full")["faults"].size(), 1u);
  ASSERT_EQ(scree("full", {"--overwrite"}).status, 0);
  expect_same("whole", "full");
}

/// A disk of a few hundred kilobytes, where the test may mount one.
TEST_F(RunControl, AFullDiskIsOneSentenceAndTheRunGoesOnLater) {
  ASSERT_EQ(scree("whole").status, 0);
  fs::create_directory(path("disk"));
  if (mount("scree_test", path("disk").c_str(), "tmpfs", 0, "size=512k") != 0) {
    GTEST_SKIP() << "no right to mount";
  }
  const ProcessResult result = scree("disk/run");
  const std::string status = record("disk/run")["status"];
  std::vector<std::string> leftovers;
  for (const auto& [name, text] : results("disk/run")) {
    if (name.ends_with(".tmp")) leftovers.push_back(name);
  }
  // The disk is enlarged and the run goes on.
  const int enlarged = mount("scree_test", path("disk").c_str(), "tmpfs", MS_REMOUNT, "size=64m");
  const bool checkpoint = fs::exists(path("disk/run") / "checkpoint.h5");
  const ProcessResult after = scree("disk/run", {checkpoint ? "--resume" : "--overwrite"});
  const auto files = results("disk/run");
  umount2(path("disk").c_str(), MNT_DETACH);
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("No space left on device"), std::string::npos) << result.err;
  EXPECT_EQ(status, "failed");
  EXPECT_TRUE(leftovers.empty()) << leftovers.front();
  ASSERT_EQ(enlarged, 0);
  EXPECT_EQ(after.status, 0) << after.err;
  EXPECT_EQ(files, results("whole"));
}

}  // namespace
}  // namespace scree

#endif
