// SPDX-License-Identifier: Apache-2.0
// Every law of materials/list.def in a tiny run: its history is in the frames and survives a
// checkpoint.
#include <gtest/gtest.h>

#include "materials/typical_input.hpp"
#include "solver/io/checkpoint.hpp"
#include "solver/io/memory_archive.hpp"
#include "verification/support/process.hpp"
#include "verification/support/scene.hpp"
#include "verification/support/temporary_folder.hpp"

namespace scree::testing {
namespace {

std::vector<std::string> models() {
  std::vector<std::string> names;
  for (const MaterialEntry& entry : material_registry()) names.push_back(entry.name);
  return names;
}

class EveryLaw : public ::testing::TestWithParam<std::string> {
 protected:
  const MaterialEntry& entry() const { return *find_material_model(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(List, EveryLaw, ::testing::ValuesIn(models()),
                         [](const auto& info) { return info.param; });

/// A block that is compressed and sheared at strain rates of 1/s and more, so that laws with a
/// yield surface flow within a few steps.
SimulationSetup squeezed_block(const MaterialEntry& entry, int dimension, Precision precision) {
  const double dx = 0.1;
  Method method;
  method.precision = precision;
  SimulationSetup setup = make_setup(dimension, method, dx, {8, 8, 8});
  const auto points = lattice(Vector(0.2, 0.2, 0.2), Vector(0.5, 0.5, 0.4), dx / 2, dimension);
  BodySetup body;
  body.name = body.material = "block";
  body.model = entry.name;
  body.input = typical_input(entry, dimension);
  body.density = 1600;
  body.particle_volume = std::pow(dx / 2, dimension);
  for (const Vector& x : points) body.position.insert(body.position.end(), {x[0], x[1], x[2]});
  Matrix L = Matrix::Zero();
  L(0, 0) = -5;
  L(1, 1) = -3;
  L(0, 1) = 4;
  set_velocity(body, Vector::Zero(), L, Vector(0.35, 0.35, 0.3));
  setup.bodies.push_back(std::move(body));
  set_steps(setup, 40, 1e-4);
  return setup;
}

MemoryArchive state_after(Simulation& simulation, int steps) {
  for (int n = 0; n < steps; ++n) simulation.step();
  MemoryArchive archive;
  simulation.save(archive);
  return archive;
}

TEST_P(EveryLaw, HistorySurvivesACheckpoint) {
  const TemporaryFolder folder;
  for (const int dimension : {2, 3}) {
    const Precision precision = dimension == 2 ? Precision::double_ : Precision::single_;
    const SimulationSetup setup = squeezed_block(entry(), dimension, precision);
    const auto whole = Simulation::create(setup);
    const MemoryArchive start = state_after(*whole, 0);
    for (int n = 0; n < 20; ++n) whole->step();
    const auto path = folder / ("state_" + std::to_string(dimension) + ".h5");
    CheckpointWriter file(path);
    whole->save(file);
    file.commit();
    const auto resumed = Simulation::create(setup);
    resumed->load(CheckpointReader(path));
    const MemoryArchive end = state_after(*whole, 20);
    EXPECT_TRUE(end == state_after(*resumed, 20)) << dimension;
    // Without the file the second half starts from another state: the comparison can fail.
    const auto fresh = Simulation::create(setup);
    EXPECT_FALSE(end == state_after(*fresh, 20)) << dimension;
    EXPECT_FALSE(end == start);
  }
}

#ifdef SCREE_EXECUTABLE

/// A deck with the typical parameters of the law that asks for all of its output fields.
std::string deck_of(const MaterialEntry& entry) {
  std::string keys, fields;
  for (const auto& key : entry.schema->entries()) {
    if (key->typical) keys += key->key + " = " + toml_number(*key->typical) + "\n";
  }
  for (const StateField& field : entry.fields) {
    if (field.output) fields += ", " + toml_string(field.name);
  }
  return R"([domain]
dimension = 2
lower = [0.0, 0.0]
upper = [0.4, 0.4]
cell_size = 0.05
[time]
end = 1e-3
[material.m]
model = ")" +
         entry.name + "\"\ndensity = 1600\n" + keys + R"([body.block]
material = "m"
shape = { type = "box", lower = [0.1, 0.1], upper = [0.3, 0.3] }
velocity = [1.0, 0.0]
[output]
fields = ["velocity", "stress")" +
         fields + "]\n";
}

TEST_P(EveryLaw, EveryOutputFieldIsInTheFrames) {
  const TemporaryFolder folder;
  write_text(folder / "tiny.toml", deck_of(entry()));
  const ProcessResult result =
      run_process({SCREE_EXECUTABLE, "run", (folder / "tiny.toml").string(), "-o",
                   (folder / "run").string(), "--quiet", "--threads", "1"});
  ASSERT_EQ(result.status, 0) << result.err;
  const std::string frame = read_text(folder / "run/frames/particles_000001.vtu");
  for (const StateField& field : entry().fields) {
    if (!field.output) continue;
    const auto at = frame.find("Name=\"" + field.name + "\"");
    ASSERT_NE(at, std::string::npos) << field.name;
    const auto from = frame.rfind('<', at);
    const std::string tag = frame.substr(from, frame.find('>', at) - from);
    const int components = field.components == 6 ? 9 : field.components;  // whole tensors
    if (components > 1) {
      const std::string width = "NumberOfComponents=\"" + std::to_string(components) + "\"";
      EXPECT_NE(tag.find(width), std::string::npos) << tag;
    }
  }
  EXPECT_EQ(frame.find("Name=\"no_such_field\""), std::string::npos);
}

#endif

}  // namespace
}  // namespace scree::testing
