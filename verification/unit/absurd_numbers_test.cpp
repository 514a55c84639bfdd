// SPDX-License-Identifier: Apache-2.0
// Numbers that nobody means are answered in a line of ordinary length.
#include <sstream>

#include "app/cli.hpp"
#include "app/run_summary.hpp"
#include "verification/support/temporary_folder.hpp"
#include "verification/unit/broken_deck.hpp"

namespace scree::testing_decks {
namespace {

TEST(AbsurdNumbers, OfSteps) {
  for (const std::string steps : {"-1", "1.5", "many", "99999999999999999999"}) {
    testing::internal::CaptureStderr();
    const char* words[] = {"scree", "run", "a.toml", "--max-steps", steps.c_str()};
    EXPECT_EQ(scree_main(5, words), 2);
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              "scree: --max-steps: " + steps +
                  " is not a whole number of at least 0; see scree run --help\n");
  }
}

TEST(AbsurdNumbers, OfAnEndlessRun) {
  const TemporaryFolder folder;
  const std::string deck = (folder / "deck.toml").string();
  write_text(deck, good_deck);
  for (const char* end : {"time.end=1e300", "time.end=1e307"}) {
    testing::internal::CaptureStdout();
    const char* words[] = {"scree", "check", deck.c_str(), "--set", end, "--set", "output.every=1"};
    EXPECT_EQ(scree_main(7, words), 0);
    std::fflush(stdout);
    std::istringstream out(testing::internal::GetCapturedStdout());
    std::string line;
    std::getline(out, line);  // the deck's path
    while (std::getline(out, line)) EXPECT_LT(line.size(), 100u) << line;
  }
}

TEST(AbsurdNumbers, OfBytesAParticleWhereNoneIsLeft) {
  RunRecord record;
  record.bytes_per_particle = 204184;
  EXPECT_EQ(run_summary(record, "run", "").find("bytes"), std::string::npos);
  EXPECT_EQ(to_json(record).find("bytes"), std::string::npos);
  record.particles = 1;
  EXPECT_NE(run_summary(record, "run", "").find("204184 bytes a particle"), std::string::npos);
  EXPECT_NE(to_json(record).find("\"bytes_per_particle\": 204184.0"), std::string::npos);
}

}  // namespace
}  // namespace scree::testing_decks
