// SPDX-License-Identifier: Apache-2.0
// The command line: exit states and sentences, all through scree_main.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "app/cli.hpp"
#include "solver/device/gpus.hpp"
#include "verification/support/process.hpp"
#include "verification/support/temporary_folder.hpp"
#include "verification/unit/broken_deck.hpp"

namespace scree::testing_decks {
namespace {

namespace fs = std::filesystem;

struct Outcome {
  int status;
  std::string out, error;
};

Outcome scree(std::vector<const char*> words) {
  words.insert(words.begin(), "scree");
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int status = scree_main(static_cast<int>(words.size()), words.data());
  std::fflush(stdout);
  return {status, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

TEST(CommandLine, HelpAndVersionAreNoMistakes) {
  const Outcome help = scree({"--help"});
  EXPECT_EQ(help.status, 0);
  for (const char* command : {"run", "check", "describe", "element", "info", "bench"}) {
    EXPECT_NE(help.out.find(command), std::string::npos) << command;
  }
  EXPECT_EQ(scree({"--version"}).status, 0);
  EXPECT_EQ(scree({"run", "--help"}).status, 0);
}

TEST(CommandLine, WithoutACommandPrintsHelpAndFails) {
  const Outcome outcome = scree({});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.error.find("describe"), std::string::npos);
}

TEST(CommandLine, UnknownCommandsGetASuggestion) {
  EXPECT_EQ(
      scree({"rnu"}).error,
      "scree: unknown command \"rnu\"; commands: run, check, describe, element, post, info, bench; "
      "did you mean \"run\"?\n");
  EXPECT_EQ(scree({"rnu"}).status, 2);
  // Without the cases of the program's main function there is no command for them.
  EXPECT_EQ(scree({"verify"}).status, 2);
  EXPECT_EQ(scree({"post", "runuot", "runs/a"}).status, 2);
  EXPECT_NE(scree({"post", "runuot", "runs/a"}).error.find("did you mean \"runout\"?"),
            std::string::npos);
}

TEST(CommandLine, UnknownOptionsGetASuggestion) {
  const Outcome outcome = scree({"run", "deck.toml", "--overwrit"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.error.find("unknown option --overwrit of scree run"), std::string::npos)
      << outcome.error;
  EXPECT_NE(outcome.error.find("did you mean --overwrite?"), std::string::npos) << outcome.error;
  EXPECT_EQ(scree({"info", "--all"}).status, 2);
}

TEST(CommandLine, WrongValuesAreTheUsersMistake) {
  EXPECT_EQ(scree({"run"}).status, 2);
  EXPECT_EQ(scree({"run", "a.toml", "b.toml"}).status, 2);
  EXPECT_EQ(scree({"run", "a.toml", "--backend", "gpu"}).status, 2);
  EXPECT_EQ(scree({"run", "a.toml", "--threads", "0"}).status, 2);
  EXPECT_EQ(scree({"run", "a.toml", "--resume", "--overwrite"}).status, 2);
  EXPECT_EQ(scree({"run", "a.toml", "--max-steps", "-1"}).status, 2);
  const Outcome until = scree({"run", "a.toml", "--until", "2 m"});
  EXPECT_EQ(until.status, 2);
  EXPECT_EQ(until.error, "scree: --until 2 m: must be a time in seconds, e.g. 0.5 or \"500 ms\"\n");
  EXPECT_EQ(scree({"bench", "--case", "jelly"}).status, 2);
}

TEST(CommandLine, CudaWithoutAGpuEndsWith2AndWritesNothing) {
  if (!find_gpus().gpus.empty()) GTEST_SKIP() << "this machine has a GPU";
  const TemporaryFolder folder;
  const std::string deck = (folder.path() / "good.toml").string();
  std::ofstream(deck) << good_deck;
  const std::string run = (folder.path() / "run").string();
  const Outcome outcome =
      scree({"run", deck.c_str(), "-o", run.c_str(), "--backend", "cuda", "--threads", "1"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.error.rfind("scree: --backend cuda: no GPU: ", 0), 0u) << outcome.error;
  EXPECT_FALSE(fs::exists(run));
  EXPECT_EQ(scree({"bench", "--backend", "cuda", "--particles", "64"}).status, 2);
}

TEST(CommandLine, AFaultyDeckEndsWith2AndWritesNothing) {
  const TemporaryFolder folder;
  const std::string deck = (folder.path() / "bad.toml").string();
  std::ofstream(deck) << with_line(9, "cfl = 0.6");
  const std::string run = (folder.path() / "run").string();
  const std::string report =
      deck + ":9:7: time.cfl = 0.6: is too large; allowed: above 0 and at most 0.5\n";
  const Outcome outcome = scree({"run", deck.c_str(), "-o", run.c_str()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.error, report);
  EXPECT_FALSE(fs::exists(run));
  EXPECT_EQ(scree({"check", deck.c_str()}).error, report);
  EXPECT_EQ(scree({"check", deck.c_str()}).status, 2);
  EXPECT_EQ(scree({"check", "no_such_deck.toml"}).status, 2);
}

TEST(Check, PredictsTheEffortAndWritesNothing) {
  const TemporaryFolder folder;
  const std::string deck = (folder.path() / "good.toml").string();
  std::ofstream(deck) << good_deck;
  const Outcome outcome =
      scree({"check", deck.c_str(), "--set", "domain.cell_size=0.02", "--set",
             "domain.upper=[0.8, 0.3]", "--set", "domain.upper=[0.8, 0.4]", "--threads", "1"});
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_NE(outcome.out.find(deck + ": valid\n"), std::string::npos) << outcome.out;
  // 0.1 m x 0.2 m in cells of 0.02 m with 3 x 3 particles each.
  const int particles = 5 * 10 * 9;
  EXPECT_NE(outcome.out.find("particles        " + std::to_string(particles) + " (column " +
                             std::to_string(particles) + ")"),
            std::string::npos)
      << outcome.out;
  for (const char* word : {"blocks", "first step", "steps", "memory", "estimated time"}) {
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

TEST(Check, AProbeOfNoParticleIsTheUsersMistake) {
  const TemporaryFolder folder;
  const std::string deck = (folder.path() / "probe.toml").string();
  std::ofstream(deck) << good_deck << "[probe.grain]\ntype = \"particle\"\nid = 7200\n";
  const Outcome outcome = scree({"check", deck.c_str(), "--threads", "1"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.error,
            "scree: probe.grain.id = 7200: there is no such particle; allowed: 0 to 7199\n");
  EXPECT_EQ(outcome.out, "");
}

TEST(Describe, UnknownTopicsGetASuggestion) {
  const Outcome outcome = scree({"describe", "drucker"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.error.find("did you mean \"drucker_prager\"?"), std::string::npos)
      << outcome.error;
  EXPECT_EQ(scree({"describe", "--markdown", "--json-schema"}).status, 2);
  const Outcome key = scree({"describe", "friction_angel"});
  EXPECT_NE(key.error.find("did you mean \"friction_angle\"?"), std::string::npos) << key.error;
}

#ifdef SCREE_EXECUTABLE
TEST(Describe, AFullDiskIsNoSuccess) {
  const int full = open("/dev/full", O_WRONLY | O_CLOEXEC);
  if (full < 0) GTEST_SKIP() << "no /dev/full";
  const ProcessResult result =
      run_process({SCREE_EXECUTABLE, "describe", "time"}, [full] { dup2(full, STDOUT_FILENO); });
  close(full);
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("the output could not be written: No space left"), std::string::npos)
      << result.err;
}
#endif

TEST(Describe, PrintsAllForms) {
  EXPECT_NE(scree({"describe"}).out.find("friction_angle"), std::string::npos);
  EXPECT_EQ(scree({"describe", "--markdown"}).out.rfind("# Deck reference", 0), 0u);
  EXPECT_EQ(scree({"describe", "--json-schema"}).out.rfind("{", 0), 0u);
  EXPECT_EQ(scree({"describe", "time"}).status, 0);
}

TEST(Info, NamesVersionBuildBackendsAndLibraries) {
  const Outcome outcome = scree({"info"});
  EXPECT_EQ(outcome.status, 0);
  for (const char* word : {"scree ", "build ", "backends ", "cpu ", "cuda ", "materials ",
                           "toml11 ", "muParser ", "CLI11 ", "fmt ", "VTK ", "HDF5 "}) {
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word << outcome.out;
  }
}

}  // namespace
}  // namespace scree::testing_decks
