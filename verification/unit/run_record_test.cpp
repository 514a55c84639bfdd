// SPDX-License-Identifier: Apache-2.0
#include "app/run_record.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/deck_changes.hpp"
#include "app/signals.hpp"
#include "verification/support/file_size_limit.hpp"
#include "verification/support/temporary_folder.hpp"

#include <csignal>

namespace scree {
namespace {

RunRecord sample_record() {
  RunRecord record;
  record.status = "failed";
  record.title = "a \"quoted\" title";
  record.steps = 12;
  record.wall_seconds = 4;
  record.particle_updates = 100;
  record.phases = {{"transfer", 1.5}};
  record.faults = {"step 12: a sentence"};
  record.cite = {"A paper"};
  return record;
}

TEST(RunRecord, HoldsTheKeysOfTheContract) {
  const auto json = nlohmann::json::parse(to_json(sample_record()));
  for (const char* key :
       {"status", "version", "backend", "threads", "particles", "steps", "simulated_time",
        "wall_seconds", "particle_updates_per_second", "phases", "faults", "cite"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["title"], "a \"quoted\" title");
  EXPECT_EQ(json["particle_updates_per_second"], 100.0 / 4);
  EXPECT_EQ(json["phases"]["transfer"], 1.5);
  EXPECT_EQ(json["faults"][0], "step 12: a sentence");
}

TEST(RunRecord, AContinuedRunAddsUp) {
  const TemporaryFolder folder;
  write_record(folder / "run.json", sample_record());
  RunRecord record;
  add_former_times(record, folder / "run.json");
  EXPECT_EQ(record.wall_seconds, 4);
  EXPECT_EQ(record.particle_updates, 100);
  EXPECT_EQ(record.phases.at("transfer"), 1.5);
  write_text(folder / "run.json", "{ \"wall_seconds\": ");  // damaged: of no importance
  add_former_times(record, folder / "run.json");
  EXPECT_EQ(record.wall_seconds, 4);
}

TEST(RunRecord, TheLastOneGoesOverTheOldOneIfItMust) {
  const TemporaryFolder folder;
  RunRecord record = sample_record();
  write_record(folder / "run.json", record);
  std::filesystem::create_directory(folder / "run.json.tmp");  // nothing can be written aside
  record.status = "interrupted";
  EXPECT_TRUE(write_last_record(folder / "run.json", record));
  EXPECT_EQ(read_text(folder / "run.json"), to_json(record));
}

TEST(DeckChanges, ReadsTheResolvedDeck) {
  const auto values = deck_values(
      "# comment\n"
      "title = \"a # b\"\n"
      "\n"
      "[material.sand]\n"
      "friction_angle = 31  # default\n"
      "points = [[0, 0],\n"
      "  [1, 0]]  # more\n");
  const std::map<std::string, std::string> expected = {
      {"title", "\"a # b\""},
      {"material.sand.friction_angle", "31"},
      {"material.sand.points", "[[0, 0], [1, 0]]"}};
  EXPECT_EQ(values, expected);
}

TEST(DeckChanges, TitlePrecisionAndALaterEndAreFree) {
  const std::string former =
      "title = \"a\"\n[time]\nend = 1\ncfl = 0.4\n[output]\nprecision = \"single\"\n";
  EXPECT_TRUE(forbidden_changes(former,
                                "title = \"b\"\n[time]\nend = 1.5\ncfl = 0.4 # default\n"
                                "[output]\nprecision = \"double\"\n")
                  .empty());
  EXPECT_EQ(forbidden_changes(
                former, "title = \"a\"\n[time]\nend = 0.5\n[output]\nprecision = \"single\"\n"),
            (std::vector<std::string>{"time.cfl = not given (was 0.4)",
                                      "time.end = 0.5 (was 1; to stop earlier use --until 0.5)"}));
}

TEST(Signals, LeaveANoteWhileCaught) {
  {
    const StopSignals caught;
    EXPECT_EQ(StopSignals::received(), 0);
    std::raise(SIGTERM);
    EXPECT_EQ(StopSignals::received(), SIGTERM);
    std::raise(SIGINT);
    EXPECT_EQ(StopSignals::received(), SIGINT);
    std::raise(SIGPIPE);  // ignored: it would end the program
  }
  EXPECT_EXIT(std::raise(SIGTERM), testing::KilledBySignal(SIGTERM), "");
}

}  // namespace
}  // namespace scree
