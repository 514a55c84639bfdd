// SPDX-License-Identifier: Apache-2.0
#include "solver/io/checkpoint.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "solver/base/error.hpp"
#include "solver/io/memory_archive.hpp"
#include "solver/io/state_buffer.hpp"
#include "verification/support/file_size_limit.hpp"
#include "verification/support/temporary_folder.hpp"

namespace scree {
namespace {

/// Doubles whose bits a careless path would lose: signed zero, subnormal, NaN with a payload.
std::vector<double> delicate_doubles() {
  return {-0.0,
          std::numeric_limits<double>::denorm_min(),
          std::bit_cast<double>(0x7ff8dead0000beefULL),
          std::numeric_limits<double>::infinity(),
          0.1,
          std::nextafter(1.0, 2.0)};
}

void put_sample(StateWriter& out) {
  out.put("body/column/position", delicate_doubles());
  out.put("body/column/speed", std::vector<float>{-0.0f, 0.1f, std::nextafter(1.0f, 2.0f)});
  out.put("id", std::vector<std::int64_t>{std::int64_t{1} << 62, -1});
  out.put("material", std::vector<std::int32_t>{7, std::numeric_limits<std::int32_t>::min()});
  out.put("flags", std::vector<std::uint8_t>{0, 255});
  out.put("none", std::vector<double>{});
  out.put_value("time", 0.1 + 0.2);
  out.put_text("deck", "title = \"Schüttung\"\n");
  out.put_text("empty", "");
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

void expect_sample(const StateReader& in) {
  EXPECT_TRUE(same_bits(in.get<double>("body/column/position"), delicate_doubles()));
  EXPECT_TRUE(same_bits(in.get<float>("body/column/speed"),
                        std::vector<float>{-0.0f, 0.1f, std::nextafter(1.0f, 2.0f)}));
  EXPECT_EQ(in.get<std::int64_t>("id"), (std::vector<std::int64_t>{std::int64_t{1} << 62, -1}));
  EXPECT_EQ(in.get<std::int32_t>("material"),
            (std::vector<std::int32_t>{7, std::numeric_limits<std::int32_t>::min()}));
  EXPECT_EQ(in.get<std::uint8_t>("flags"), (std::vector<std::uint8_t>{0, 255}));
  EXPECT_TRUE(in.get<double>("none").empty());
  EXPECT_EQ(in.get_value<double>("time"), 0.1 + 0.2);
  EXPECT_EQ(in.text("deck"), "title = \"Schüttung\"\n");
  EXPECT_EQ(in.text("empty"), "");
  EXPECT_TRUE(in.has("body/column/speed"));
  EXPECT_FALSE(in.has("body/row/speed"));
}

void write_checkpoint(const std::filesystem::path& path) {
  CheckpointWriter out(path);
  put_sample(out);
  out.commit();
}

template <class Action>
std::string run_fault(Action action) {
  try {
    action();
  } catch (const RunFault& fault) {
    return fault.what();
  }
  return "no fault";
}

TEST(Checkpoint, MemoryGivesBackTheBits) {
  MemoryArchive archive;
  put_sample(archive);
  expect_sample(archive);
}

TEST(Checkpoint, ABufferHandsOnTheBits) {
  StateBuffer buffer;
  put_sample(buffer);
  MemoryArchive archive;
  buffer.replay(archive);
  expect_sample(archive);
}

TEST(Checkpoint, ABufferedFileIsTheSameFile) {
  const TemporaryFolder folder;
  write_checkpoint(folder / "direct.h5");
  StateBuffer buffer;
  put_sample(buffer);
  CheckpointWriter out(folder / "buffered.h5");
  buffer.replay(out);
  out.commit();
  EXPECT_TRUE(read_text(folder / "direct.h5") == read_text(folder / "buffered.h5"));
}

TEST(Checkpoint, FileGivesBackTheBits) {
  const TemporaryFolder folder;
  write_checkpoint(folder / "checkpoint.h5");
  expect_sample(CheckpointReader(folder / "checkpoint.h5"));
  EXPECT_FALSE(std::filesystem::exists(folder / "checkpoint.h5.tmp"));
}

TEST(Checkpoint, WithoutCommitTheOldOneStays) {
  const TemporaryFolder folder;
  write_checkpoint(folder / "checkpoint.h5");
  {
    CheckpointWriter out(folder / "checkpoint.h5");
    out.put_value("time", 3.0);
  }
  expect_sample(CheckpointReader(folder / "checkpoint.h5"));
  EXPECT_FALSE(std::filesystem::exists(folder / "checkpoint.h5.tmp"));
}

TEST(Checkpoint, WrongNameOrTypeIsAFault) {
  const TemporaryFolder folder;
  write_checkpoint(folder / "checkpoint.h5");
  const CheckpointReader in(folder / "checkpoint.h5");
  EXPECT_NE(run_fault([&] { in.get<double>("mass"); }).find("'mass' is missing"),
            std::string::npos);
  EXPECT_NE(run_fault([&] { in.get<float>("time"); }).find("another type"), std::string::npos);
  EXPECT_NE(run_fault([&] { in.get<std::uint8_t>("deck"); }).find("another type"),
            std::string::npos);
  EXPECT_NE(run_fault([&] { in.text("flags"); }).find("another type"), std::string::npos);
  EXPECT_NE(run_fault([&] { in.get_value<std::int64_t>("id"); }).find("2 numbers"),
            std::string::npos);
}

TEST(Checkpoint, EveryTruncationIsNoticed) {
  const TemporaryFolder folder;
  write_checkpoint(folder / "whole.h5");
  const std::string whole = read_text(folder / "whole.h5");
  for (std::size_t length :
       {std::size_t{0}, std::size_t{7}, std::size_t{100}, whole.size() / 2, whole.size() - 1}) {
    write_text(folder / "cut.h5", whole.substr(0, length));
    const std::string fault = run_fault([&] { CheckpointReader in(folder / "cut.h5"); });
    EXPECT_NE(fault.find("cut.h5: it is truncated, damaged or not an HDF5 file"), std::string::npos)
        << length << ": " << fault;
  }
}

TEST(Checkpoint, AChangedBitIsNoticed) {
  const TemporaryFolder folder;
  {
    CheckpointWriter out(folder / "whole.h5");
    out.put("position", std::vector<double>(1000, 0.123456789));
    out.commit();
  }
  std::string bytes = read_text(folder / "whole.h5");
  const auto pattern = std::bit_cast<std::array<char, 8>>(0.123456789);
  const std::size_t at = bytes.find(std::string(pattern.data(), 8));
  ASSERT_NE(at, std::string::npos);
  bytes[at + 8 * 500] = static_cast<char>(bytes[at + 8 * 500] ^ 1);
  write_text(folder / "bit.h5", bytes);
  const CheckpointReader in(folder / "bit.h5");
  EXPECT_NE(run_fault([&] { in.get<double>("position"); }).find("'position' is damaged"),
            std::string::npos);
}

TEST(Checkpoint, ForeignFilesAreRefused) {
  const TemporaryFolder folder;
  write_text(folder / "text.h5", "not HDF5 at all\n");
  EXPECT_NE(run_fault([&] { CheckpointReader in(folder / "text.h5"); }).find("not an HDF5 file"),
            std::string::npos);
  EXPECT_NE(run_fault([&] { CheckpointReader in(folder / "none.h5"); }).find("no such file"),
            std::string::npos);
  EXPECT_NE(run_fault([&] { CheckpointReader in(folder.path()); }).find("no such file"),
            std::string::npos);
}

TEST(Checkpoint, FullDiskLeavesTheOldOne) {
  const TemporaryFolder folder;
  write_checkpoint(folder / "checkpoint.h5");
  for (const rlim_t bytes : {rlim_t{0}, rlim_t{100}, rlim_t{30000}}) {
    const std::string fault = run_fault([&] {
      const FileSizeLimit limit(bytes);
      CheckpointWriter out(folder / "checkpoint.h5");
      out.put("large", std::vector<double>(100000, 1.0));
      out.commit();
    });
    EXPECT_NE(
        fault.find("cannot write " + (folder / "checkpoint.h5").string() + ": File too large"),
        std::string::npos)
        << bytes << ": " << fault;
    expect_sample(CheckpointReader(folder / "checkpoint.h5"));
    EXPECT_FALSE(std::filesystem::exists(folder / "checkpoint.h5.tmp"));
  }
}

}  // namespace
}  // namespace scree
