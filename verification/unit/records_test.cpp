// SPDX-License-Identifier: Apache-2.0
// What a run records besides its history: series of frames, filters, windows, tables of samples.
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "app/recorder.hpp"
#include "app/run_loop.hpp"
#include "app/sampler.hpp"
#include "solver/base/error.hpp"
#include "solver/io/checkpoint.hpp"
#include "verification/support/fake_simulation.hpp"
#include "verification/support/temporary_folder.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> split(const std::string& text, char end) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, end);) parts.push_back(part);
  return parts;
}

/// The numbers of a line of a table.
std::vector<double> numbers(const std::string& line) {
  std::vector<double> values;
  for (const std::string& cell : split(line, ',')) values.push_back(std::stod(cell));
  return values;
}

DomainSpec unit_domain(int dimension) {
  DomainSpec domain;
  domain.dimension = dimension;
  domain.upper = {1, 1, dimension == 3 ? 1.0 : 0.0};
  domain.cell_size = 0.25;
  return domain;
}

/// Particles of given positions and volumes, whose field "f" is 10 x + y and whose "v" is (x, y,
/// 7).
ParticleSnapshot particles_at(const std::vector<std::array<double, 3>>& places,
                              const std::vector<double>& volumes) {
  ParticleSnapshot snapshot;
  snapshot.time = 0.5;
  snapshot.step = 4;
  snapshot.fields = {{"f", "", 1, {}}, {"v", "", 3, {}}, {"volume", "m^3", 1, volumes}};
  for (const auto& x : places) {
    snapshot.id.push_back(std::int64_t(snapshot.id.size()));
    snapshot.position.insert(snapshot.position.end(), x.begin(), x.end());
    snapshot.fields[0].values.push_back(10 * x[0] + x[1]);
    snapshot.fields[1].values.insert(snapshot.fields[1].values.end(), {x[0], x[1], 7});
  }
  return snapshot;
}

TEST(Schedule, StreamsHaveTheirOwnTimesAndWindows) {
  Schedule schedule(1.0, 0, 0, 0);
  const int stream = schedule.add({0.25, 0.3, 0.8});
  for (const double t : {0.0, 0.25, 1.0}) EXPECT_FALSE(schedule.due(stream, t)) << t;
  for (const double t : {0.5, 0.75}) EXPECT_TRUE(schedule.due(stream, t)) << t;
  EXPECT_TRUE(schedule.record_due(0.5));
  EXPECT_EQ(schedule.next_event(0), 0.5);
  EXPECT_EQ(schedule.next_event(0.5), 0.75);
  EXPECT_EQ(schedule.next_event(0.75), 1.0);
  EXPECT_GE(schedule.count(stream), 2u);
  const int always = schedule.add({0.4});
  for (const double t : {0.0, 0.4, 0.8, 1.0}) EXPECT_TRUE(schedule.due(always, t)) << t;
}

TEST(Samples, APointIsTheWeightedMeanAroundIt) {
  ProbeSpec spec;
  spec.name = "here";
  spec.at = {0.5, 0.5, 0};
  spec.radius = 0.2;
  spec.fields = {"f", "v"};
  const auto probe = make_sampler(spec, unit_domain(2));
  EXPECT_EQ(probe->file(), "probes/here.csv");
  EXPECT_EQ(probe->fields(), (std::vector<std::string>{"f", "v", "volume"}));
  // Distances 0, 0.1 and beyond: weights 1 and 1/2 times volumes 1 and 2.
  const auto snapshot = particles_at({{0.5, 0.5, 0}, {0.6, 0.5, 0}, {0.5, 0.8, 0}}, {1, 2, 1});
  EXPECT_EQ(probe->header(snapshot), "step,time,particles,f,v_x,v_y,v_z");
  const std::vector<double> row = numbers(probe->lines(snapshot));
  const std::vector<double> expected{4, 0.5, 2, (5.5 + 6.5) / 2, 0.55, 0.5, 7};
  ASSERT_EQ(row.size(), expected.size());
  for (std::size_t i = 0; i < row.size(); ++i) EXPECT_NEAR(row[i], expected[i], 1e-14) << i;
  const auto filter = probe->filter();
  EXPECT_TRUE(filter(0, &snapshot.position[3]));
  EXPECT_FALSE(filter(0, &snapshot.position[6]));
  EXPECT_EQ(probe->lines(particles_at({}, {})), "4,0.5,0,nan,nan,nan,nan\n");
}

TEST(Samples, AProfileHasARowForEachBinWithParticles) {
  ProfileSpec spec;
  spec.name = "up";
  spec.from = {0.5, 0, 0};
  spec.to = {0.5, 1, 0};
  spec.bins = 4;
  spec.radius = 0.1;
  spec.fields = {"f"};
  const auto profile = make_sampler(spec, unit_domain(2));
  // Two in the lowest bin, one at the very end, one beside the line.
  const auto snapshot =
      particles_at({{0.5, 0.1, 0}, {0.55, 0.2, 0}, {0.5, 1.0, 0}, {0.7, 0.6, 0}}, {1, 3, 1, 1});
  const auto rows = split(profile->lines(snapshot), '\n');
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(profile->header(snapshot).substr(0, 26), "step,time,s,x,y,z,particle");
  const std::vector<double> first = numbers(rows[0]), last = numbers(rows[1]);
  const std::vector<double> lowest{4, 0.5, 0.125, 0.5, 0.125, 0, 2, (5.1 + 3 * 5.7) / 4};
  ASSERT_EQ(first.size(), lowest.size() + 3);  // the snapshot has v too
  for (std::size_t i = 0; i < lowest.size(); ++i) EXPECT_NEAR(first[i], lowest[i], 1e-14) << i;
  EXPECT_EQ(last[2], 0.875);
  EXPECT_EQ(last[6], 1);
}

TEST(Samples, ASectionIsASlabOfSquares) {
  SectionSpec spec;
  spec.name = "cut";
  spec.normal = SectionNormal::y;
  spec.position = 0.5;
  spec.spacing = 0.5;
  spec.thickness = 0.2;
  spec.fields = {"f"};
  const auto section = make_sampler(spec, unit_domain(3));
  const auto snapshot =
      particles_at({{0.1, 0.45, 0.9}, {0.2, 0.55, 0.8}, {0.9, 0.61, 0.1}}, {1, 1, 1});
  const auto rows = split(section->lines(snapshot), '\n');
  ASSERT_EQ(rows.size(), 1u);  // the third is beyond the slab
  const std::vector<double> row = numbers(rows[0]);
  EXPECT_EQ(row[2], 0.25);
  EXPECT_EQ(row[3], 0.5);
  EXPECT_EQ(row[4], 0.75);
  EXPECT_EQ(row[5], 2);
  EXPECT_NEAR(row[6], (1.45 + 2.55) / 2, 1e-15);  // rounding of one sum
}

TEST(Samples, FramesMayHoldSomeParticles) {
  OutputSpec spec;
  EXPECT_FALSE(frame_filter(spec, 2));
  spec.every_nth = 3;
  ShapeSpec box;
  box.upper = {1, 1, 0};
  spec.region = box;
  const auto filter = frame_filter(spec, 2);
  const double inside[3] = {1.0, 0.5, 0}, outside[3] = {1.01, 0.5, 0};
  EXPECT_TRUE(filter(6, inside));  // the rim counts
  EXPECT_FALSE(filter(7, inside));
  EXPECT_FALSE(filter(6, outside));
}

/// A run of the stand-in simulation that records everything.
class RecordedRun {
 public:
  static constexpr double stable = 0.0013;

  static Deck deck() {
    Deck deck;
    deck.domain = unit_domain(2);
    OutputSpec further;
    further.name = "some";
    further.every = 0.05;
    further.fields = {"pressure"};
    further.every_nth = 5;
    further.from = 0.1;
    further.until = 0.6;
    deck.frames = {further};
    ProbeSpec place;
    place.name = "place";
    place.at = {0.5, 1, 0};
    place.radius = 0.3;
    place.fields = {"pressure", "volume"};
    ProbeSpec grain = place;
    grain.name = "grain";
    grain.type = ProbeType::particle;
    deck.probes = {place, grain};
    return deck;
  }

  static Schedule schedule() {
    Schedule schedule(1.0, 0.02, 0.1, 0.25);
    schedule.add({0.05, 0.1, 0.6});
    schedule.add({0.01});
    schedule.add({0.03});
    return schedule;
  }

  static void run(const fs::path& path, FolderMode mode, const RunLimits& limits = {}) {
    const RunFolder folder = RunFolder::open(path, mode);
    FakeSimulation simulation(schedule(), stable, 50);
    OutputSpec output;
    output.format = FrameFormat::xdmf;
    output.precision = FramePrecision::double_;
    output.fields = {"pressure"};
    output.grid = true;
    Recorder recorder(folder, output, true, schedule(), {"", "cpu", "0.1.0"});
    add_records(deck(), recorder);
    if (mode == FolderMode::resume) {
      const CheckpointReader checkpoint(folder.checkpoint());
      simulation.load(checkpoint);
      recorder.resume(simulation, checkpoint, {});
    } else {
      recorder.start(simulation, {});
    }
    run_loop(simulation, schedule(), recorder, limits, [] {});
  }

  /// All files but those of HDF5, whose bytes may lie otherwise.
  static std::map<std::string, std::string> texts(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (!entry.is_regular_file() || entry.path().extension() == ".h5") continue;
      files[fs::relative(entry.path(), folder).string()] = read_text(entry.path());
    }
    return files;
  }
};

TEST(Records, EveryStreamHasItsTimes) {
  const TemporaryFolder folder;
  RecordedRun::run(folder / "run", FolderMode::fresh);
  const auto files = RecordedRun::texts(folder / "run");
  EXPECT_EQ(split(files.at("probes/place.csv"), '\n').size(), 1 + 101u);
  EXPECT_EQ(split(files.at("probes/grain.csv"), '\n').size(), 1 + 35u);  // 0, 0.03 to 0.99, 1
  EXPECT_EQ(split(files.at("some.pvd"), '\n').size(), 5 + 11u);          // 0.1 to 0.6
  const auto rows = split(files.at("probes/grain.csv"), '\n');
  EXPECT_EQ(rows[0], "step,time,id,x,y,z,pressure,volume");
  // x = 0.1 + 0.8 p/50 is 0.5 for the particle 25.
  EXPECT_EQ(numbers(rows[1])[2], 25);
  EXPECT_EQ(numbers(rows[35])[2], 25);
}

TEST(Records, AContinuedRunHasTheSameFiles) {
  const TemporaryFolder folder;
  RecordedRun::run(folder / "whole", FolderMode::fresh);
  RunLimits limits;
  limits.until = 0.41;
  RecordedRun::run(folder / "parts", FolderMode::fresh, limits);
  fs::copy(folder / "parts" / "checkpoint.h5", folder / "kept.h5");
  limits.until = 0.77;
  RecordedRun::run(folder / "parts", FolderMode::resume, limits);
  // Back to the first checkpoint: rows and frames after it are cut off.
  fs::copy(folder / "kept.h5", folder / "parts" / "checkpoint.h5",
           fs::copy_options::overwrite_existing);
  RecordedRun::run(folder / "parts", FolderMode::resume);
  EXPECT_EQ(RecordedRun::texts(folder / "parts"), RecordedRun::texts(folder / "whole"));
}

TEST(Records, AnOverwrittenRunLeavesNothing) {
  const TemporaryFolder folder;
  RecordedRun::run(folder / "run", FolderMode::fresh);
  write_text(folder / "run" / "run.json", "{}");
  write_text(folder / "run" / "resolved.toml",
             "[frames.some]\nevery = 1\n[probe.place]\n[probe.grain]\n");
  write_text(folder / "run" / "mine.h5", "not of the run");
  { const RunFolder again = RunFolder::open(folder / "run", FolderMode::overwrite); }
  std::vector<std::string> left;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "run")) {
    left.push_back(fs::relative(entry.path(), folder / "run").string());
  }
  std::sort(left.begin(), left.end());
  EXPECT_EQ(left, (std::vector<std::string>{"frames", "mine.h5"}));
}

}  // namespace
}  // namespace scree
