// SPDX-License-Identifier: Apache-2.0
#include "app/run_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "solver/base/error.hpp"
#include "verification/support/temporary_folder.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

std::string refusal(const fs::path& path, FolderMode mode) {
  try {
    RunFolder::open(path, mode);
  } catch (const UserError& error) {
    return error.what();
  }
  return "accepted";
}

void leave_run(const fs::path& path) {
  fs::create_directories(path / "frames");
  for (const char* name : {"run.json", "resolved.toml", "history.csv", "particles.pvd", "grid.pvd",
                           "checkpoint.h5", "checkpoint.h5.tmp", "frames/particles_000000.vtu",
                           "frames/particles_000001.vtu.tmp", "frames/grid_minus_000000.vti"}) {
    write_text(path / name, "x");
  }
}

TEST(RunFolder, NameComesFromTheDeck) {
  EXPECT_EQ(default_run_folder("inputs/tutorial/sand_column_2d.toml"), "runs/sand_column_2d");
}

TEST(RunFolder, IsMadeWithItsParents) {
  const TemporaryFolder folder;
  RunFolder::open(folder / "a/b/run", FolderMode::fresh);
  EXPECT_TRUE(fs::is_directory(folder / "a/b/run/frames"));
}

TEST(RunFolder, AnEmptyFolderIsWelcome) {
  const TemporaryFolder folder;
  EXPECT_EQ(refusal(folder.path(), FolderMode::fresh), "accepted");
}

TEST(RunFolder, AFormerRunIsNotTouchedUnasked) {
  const TemporaryFolder folder;
  leave_run(folder / "run");
  const std::string sentence = refusal(folder / "run", FolderMode::fresh);
  EXPECT_NE(sentence.find("holds a run already"), std::string::npos);
  EXPECT_NE(sentence.find("--resume"), std::string::npos);
  EXPECT_NE(sentence.find("--overwrite"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "run/history.csv"));
}

TEST(RunFolder, OverwriteRemovesTheRunAndNothingElse) {
  const TemporaryFolder folder;
  leave_run(folder / "run");
  write_text(folder / "run/notes.txt", "mine");
  write_text(folder / "run/frames/picture.png", "mine");
  write_text(folder / "run/frames/particles_mine.vtu", "mine");
  EXPECT_EQ(refusal(folder / "run", FolderMode::overwrite), "accepted");
  std::vector<std::string> left;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "run")) {
    if (entry.is_regular_file()) left.push_back(entry.path().filename().string());
  }
  std::sort(left.begin(), left.end());
  EXPECT_EQ(left, (std::vector<std::string>{"notes.txt", "particles_mine.vtu", "picture.png"}));
}

TEST(RunFolder, AForeignFolderIsNeverTouched) {
  const TemporaryFolder folder;
  write_text(folder / "history.csv", "a table of somebody");
  for (const FolderMode mode : {FolderMode::fresh, FolderMode::overwrite}) {
    EXPECT_NE(refusal(folder.path(), mode).find("no run"), std::string::npos);
    EXPECT_EQ(read_text(folder / "history.csv"), "a table of somebody");
  }
}

TEST(RunFolder, ResumeNeedsACheckpoint) {
  const TemporaryFolder folder;
  EXPECT_NE(refusal(folder / "none", FolderMode::resume).find("start without --resume"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "none"));
  leave_run(folder / "run");
  fs::remove(folder / "run/checkpoint.h5");
  EXPECT_NE(refusal(folder / "run", FolderMode::resume).find("start anew with --overwrite"),
            std::string::npos);
}

TEST(RunFolder, ImpossiblePathsAreTheUsersMistake) {
  const TemporaryFolder folder;
  write_text(folder / "file", "");
  EXPECT_NE(refusal(folder / "file", FolderMode::fresh).find("is not a folder"), std::string::npos);
  EXPECT_NE(refusal(folder / "file/run", FolderMode::fresh).find("Not a directory"),
            std::string::npos);
  EXPECT_NE(refusal("/proc/run", FolderMode::fresh).find("/proc/run"), std::string::npos);
}

TEST(RunFolder, ASecondRunIsKeptOut) {
  const TemporaryFolder folder;
  leave_run(folder / "run");
  {
    const RunFolder first = RunFolder::open(folder / "run", FolderMode::resume);
    EXPECT_NE(refusal(folder / "run", FolderMode::resume).find("in use"), std::string::npos);
    EXPECT_NE(refusal(folder / "run", FolderMode::overwrite).find("in use"), std::string::npos);
    EXPECT_TRUE(fs::exists(folder / "run/history.csv"));
  }
  EXPECT_EQ(refusal(folder / "run", FolderMode::resume), "accepted");
}

TEST(RunFolder, ARunKilledInItsFirstMomentIsNoObstacle) {
  const TemporaryFolder folder;
  RunFolder::open(folder / "run", FolderMode::fresh);
  write_text(folder / "run/run.json.tmp", "{");
  EXPECT_EQ(refusal(folder / "run", FolderMode::fresh), "accepted");
}

}  // namespace
}  // namespace scree
