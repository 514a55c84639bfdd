// SPDX-License-Identifier: Apache-2.0
#include "solver/io/history_writer.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "solver/base/error.hpp"
#include "verification/support/file_size_limit.hpp"
#include "verification/support/temporary_folder.hpp"

namespace scree {
namespace {

HistoryRow sample_row(std::int64_t step) {
  HistoryRow row;
  row.step = step;
  row.time = static_cast<double>(step) * 0.1;  // 0.1, 0.3 ... need 17 digits
  row.dt = 1.0 / 3.0;
  row.particle_count = 5;
  row.mass = 2.0 / 3.0;
  for (int a = 0; a < 3; ++a) {
    row.momentum[a] = -1e-300 * (a + 1);
    row.angular_momentum[a] = 1e300 / (a + 3);
    row.center[a] = a / 7.0;
  }
  row.kinetic_energy = 11.0;
  row.elastic_energy = 12.0;
  row.max_speed = 13.0;
  return row;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<double> numbers_of(const std::string& line) {
  std::vector<double> numbers;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) {
    numbers.push_back(std::strtod(cell.c_str(), nullptr));
  }
  return numbers;
}

TEST(History, ColumnsAreThoseOfTheContract) {
  const TemporaryFolder folder;
  HistoryWriter::create(folder / "history.csv", {{"plate"}});
  EXPECT_EQ(read_text(folder / "history.csv"),
            "step,time,dt,particle_count,mass,momentum_x,momentum_y,momentum_z,"
            "angular_momentum_x,angular_momentum_y,angular_momentum_z,center_x,center_y,center_z,"
            "kinetic_energy,elastic_energy,max_speed,"
            "plate_force_x,plate_force_y,plate_force_z,"
            "plate_torque_x,plate_torque_y,plate_torque_z,plate_work\n");
}

TEST(History, PoresAndLoadsAddTheirColumns) {
  const std::vector<std::string> plain = history_columns({}),
                                 full = history_columns({{}, DrainNames({"top"}), true});
  const std::vector<std::string> more(full.begin() + std::ptrdiff_t(plain.size()), full.end());
  const std::vector<std::string> expected{
      "fluid_mass",    "fluid_outflow",     "fluid_balance_error", "pressure_iterations",
      "step_halvings", "fluid_outflow_top", "external_work"};
  EXPECT_EQ(more, expected);
}

TEST(History, WaterThatFlowsHasItsBalanceAndTheOutflowOfEachSurface) {
  const TemporaryFolder folder;
  HistoryRow row = sample_row(3);
  row.fluid = FluidBalance{0.1, 0.3, 1.0 / 3.0, 7, {0.2, 0.1}, 5};
  row.collider_force_torque = {{1, 2, 3, 4, 5, 6}};
  row.collider_work = {7};
  HistoryWriter writer =
      HistoryWriter::create(folder / "history.csv", {{"plate"}, DrainNames({"top", "fluid"})});
  writer.add(row);
  const auto lines = lines_of(read_text(folder / "history.csv"));
  EXPECT_NE(
      lines[0].find(
          ",max_speed,fluid_mass,fluid_outflow,fluid_balance_error,"
          "pressure_iterations,step_halvings,fluid_outflow_top,fluid_outflow_fluid,plate_force_x"),
      std::string::npos);
  const std::vector<double> numbers = numbers_of(lines[1]);
  const std::vector<double> expected = {0.1, 0.3, 1.0 / 3.0, 7, 5, 0.2, 0.1, 1};
  ASSERT_EQ(numbers.size(), 17 + 7 + 7u);
  EXPECT_EQ(std::vector<double>(numbers.begin() + 17, numbers.begin() + 25), expected);
  row.fluid->surfaces.pop_back();
  EXPECT_THROW(writer.add(row), std::logic_error);
  row.fluid.reset();
  EXPECT_THROW(writer.add(row), std::logic_error);
}

TEST(History, NumbersComeBackExactly) {
  const TemporaryFolder folder;
  HistoryRow row = sample_row(3);
  row.collider_force_torque = {{0.1, 0.2, 0.3, 0.4, 0.5, 0.6}};
  row.collider_work = {0.7};
  HistoryWriter::create(folder / "history.csv", {{"plate"}}).add(row);
  const std::vector<double> numbers = numbers_of(lines_of(read_text(folder / "history.csv"))[1]);
  const std::vector<double> expected = {3,       3 * 0.1, 1.0 / 3.0, 5,         2.0 / 3.0, -1e-300,
                                        -2e-300, -3e-300, 1e300 / 3, 1e300 / 4, 1e300 / 5, 0,
                                        1 / 7.0, 2 / 7.0, 11,        12,        13,        0.1,
                                        0.2,     0.3,     0.4,       0.5,       0.6,       0.7};
  EXPECT_EQ(numbers, expected);  // exact: the file gives every double back
}

TEST(History, RowsAreOutAtOnce) {
  const TemporaryFolder folder;
  HistoryWriter writer = HistoryWriter::create(folder / "history.csv", {});
  writer.add(sample_row(0));
  EXPECT_EQ(lines_of(read_text(folder / "history.csv")).size(), 2u);  // without closing
  writer.add(sample_row(1));
  EXPECT_EQ(lines_of(read_text(folder / "history.csv")).size(), 3u);
}

TEST(History, ResumeCutsBackAndGoesOn) {
  const TemporaryFolder folder;
  const auto path = folder / "history.csv";
  {
    HistoryWriter writer = HistoryWriter::create(path, {});
    for (std::int64_t step : {0, 4, 8, 12}) writer.add(sample_row(step));
  }
  const std::string whole = read_text(path);
  write_text(path, whole + "16,1.6,0.3");  // a row that a crash of the system left half
  HistoryWriter::resume(path, {}, 12);
  EXPECT_EQ(read_text(path), whole);
  HistoryWriter::resume(path, {}, 9).add(sample_row(12));
  EXPECT_EQ(read_text(path), whole);
  HistoryWriter::resume(path, {}, 0);
  EXPECT_EQ(lines_of(read_text(path)).size(), 2u);
}

TEST(History, ResumeRefusesOtherColumns) {
  const TemporaryFolder folder;
  HistoryWriter::create(folder / "history.csv", {{"plate"}});
  EXPECT_THROW(HistoryWriter::resume(folder / "history.csv", {}, 0), RunFault);
  EXPECT_THROW(HistoryWriter::resume(folder / "none.csv", {}, 0), RunFault);
}

TEST(History, FullDiskLeavesWholeRows) {
  const TemporaryFolder folder;
  const auto path = folder / "history.csv";
  HistoryWriter writer = HistoryWriter::create(path, {});
  writer.add(sample_row(0));
  const std::string before = read_text(path);
  {
    const FileSizeLimit limit(before.size() + 10);  // room for a part of the next row
    try {
      writer.add(sample_row(1));
      ADD_FAILURE() << "no fault";
    } catch (const RunFault& fault) {
      EXPECT_EQ(std::string(fault.what()), "cannot write " + path.string() + ": File too large");
    }
  }
  EXPECT_EQ(read_text(path), before);
  EXPECT_THROW(HistoryWriter::create("/dev/full", {}), RunFault);
}

}  // namespace
}  // namespace scree
