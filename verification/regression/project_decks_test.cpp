// SPDX-License-Identifier: Apache-2.0
// Every deck of inputs that describes a run does run: it gives no warning and takes its first
// steps.
#include <gtest/gtest.h>

#include "solver/deck/deck.hpp"
#include "verification/support/example_decks.hpp"
#include "verification/support/process.hpp"
#include "verification/support/temporary_folder.hpp"

#ifdef SCREE_EXECUTABLE

namespace scree {
namespace {

namespace fs = std::filesystem;

/// Decks of `scree element` are of another kind.
std::vector<fs::path> decks() {
  std::vector<fs::path> paths = testing::decks_below("");
  std::erase_if(paths, [](const fs::path& p) { return p.parent_path().filename() == "element"; });
  return paths;
}

class ProjectDecks : public ::testing::TestWithParam<fs::path> {
 protected:
  /// A deck that comes with a small twin has millions of particles: one a cell instead.
  std::vector<std::string> thinned() const {
    const fs::path& deck = GetParam();
    const fs::path twin = deck.parent_path() / (deck.stem().string() + "_small.toml");
    if (!fs::exists(twin)) return {};
    Problems problems;
    std::vector<std::string> options;
    for (const BodySpec& body : read_deck(deck.string(), {}, problems).bodies) {
      const std::string key = "body." + toml_key(body.name) + ".particles_per_direction";
      options.insert(options.end(), {"--set", key + "=1"});
    }
    return options;
  }

  TemporaryFolder folder_;
};

TEST_P(ProjectDecks, RunsItsFirstSteps) {
  const std::string run = (folder_ / "run").string();
  std::vector<std::string> command{
      SCREE_EXECUTABLE,    "run", GetParam().string(), "-o", run, "--max-steps", "2", "--set",
      "output.format=none"};
  const auto more = thinned();
  command.insert(command.end(), more.begin(), more.end());
  const ProcessResult result = run_process(command);
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_NE(read_text(fs::path(run) / "run.json").find("\"steps\": 2,"), std::string::npos);
}

std::string test_name(const ::testing::TestParamInfo<fs::path>& info) {
  return info.param.parent_path().filename().string() + "_" + info.param.stem().string();
}

INSTANTIATE_TEST_SUITE_P(Inputs, ProjectDecks, ::testing::ValuesIn(decks()), test_name);

TEST(RunWarnings, AreGivenAtTheStartUnlessQuiet) {
  const TemporaryFolder folder;
  const std::string deck = SCREE_SOURCE_DIR "/inputs/tutorial/sliding_block.toml";
  std::vector<std::string> command{SCREE_EXECUTABLE, "run", deck, "-o", (folder / "run").string()};
  for (const char* word :
       {"--max-steps", "1", "--overwrite", "--set", "body.twin.material=block", "--set",
        "body.twin.shape={ type = \"box\", lower = [0.2, 0.0], upper = [0.3, 0.1] }"}) {
    command.emplace_back(word);
  }
  EXPECT_EQ(
      run_process(command).err.rfind("scree: warning: the bodies block and twin overlap: ", 0), 0u);
  command.emplace_back("--quiet");
  EXPECT_EQ(run_process(command).err, "");
}

}  // namespace
}  // namespace scree

#endif
