// SPDX-License-Identifier: Apache-2.0
// Colliders of a run: where they stand, their files, and the history against their way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "postproc/colliders/run_colliders.hpp"
#include "verification/support/process.hpp"
#include "verification/support/synthetic_run.hpp"

namespace scree {
namespace {

using Json = nlohmann::json;

constexpr const char* walls = R"([collider.floor]
shape = { type = "box", lower = [0.0, -0.1], upper = [1.0, 0.0] }
contact.type = "sticky"
[collider.wall]
shape = { type = "box", lower = [0.8, 0.0], upper = [1.0, 1.0] }
velocity = ["-0.4*t", 0.0]
contact.type = "slip"
)";

class PostColliders : public testing::Test {
 protected:
  PostColliders() : run_(2, {1, 1, 0}, 0.1, 2, walls) {
    ParticleSnapshot body = lattice_particles({{0, 0, 0}, {0.5, 0.5, 0}}, 0.05, 2);
    add_field(body, "pressure", [](const double* x) { return 1 - x[1]; });
    run_.add(body, 0);
    run_.add(body, 1);
    // A force of 10 N/m for each metre of way, drawn at five times.
    std::string text = "step,time,dt,kinetic_energy,elastic_energy,momentum_x,wall_force_x\n";
    for (int i = 0; i <= 4; ++i) {
      const double t = 0.25 * i;
      text += fmt::format("{},{},0.25,{},0,0,{}\n", i, t, t, 10 * 0.2 * t * t);
    }
    write_text(run_ / "history.csv", text);
  }

  ProcessResult post(std::vector<std::string> words) const {
    words.insert(words.begin(), {SCREE_EXECUTABLE, "post"});
    return run_process(words);
  }

  SyntheticRun run_;
};

TEST_F(PostColliders, TheyStandWhereTheirVelocityHasCarriedThem) {
  const std::vector<RunCollider> colliders = run_colliders(scree::Run(run_.path()), {0, 0.5, 1});
  ASSERT_EQ(colliders.size(), 2u);
  EXPECT_FALSE(colliders[0].moves());
  ASSERT_TRUE(colliders[1].moves());
  for (const std::size_t k : {0u, 1u, 2u}) {
    const double t = 0.5 * double(k), way = -0.2 * t * t;
    EXPECT_NEAR(colliders[1].displacement(k)[0], way, 1e-15);  // midpoints: exact for a line
    double left = 1;
    for (const auto& point : colliders[1].surface(k).points) left = std::min(left, point[0]);
    EXPECT_NEAR(left, 0.8 + way, 1e-15);
  }
}

TEST_F(PostColliders, OneFileForThoseAtRestAndOneAFrameForOthers) {
  const ProcessResult result = post({"colliders", run_.path()});
  ASSERT_EQ(result.status, 0) << result.err;
  const std::string index = read_text(run_ / "colliders.pvd");
  for (const char* line : {"timestep=\"0\" part=\"0\" file=\"colliders_files/00.vtp\"",
                           "timestep=\"1\" part=\"0\" file=\"colliders_files/00.vtp\"",
                           "timestep=\"0\" part=\"1\" file=\"colliders_files/01_000000.vtp\"",
                           "timestep=\"1\" part=\"1\" file=\"colliders_files/01_000001.vtp\""}) {
    EXPECT_NE(index.find(line), std::string::npos) << line << " in\n" << index;
  }
  for (const char* file : {"00.vtp", "01_000000.vtp", "01_000001.vtp"})
    EXPECT_TRUE(std::filesystem::exists(run_ / ("colliders_files/" + std::string(file))));
}

TEST_F(PostColliders, ThePictureShowsThemUnlessTheyAreLeftOut) {
  if (!std::filesystem::exists("/usr/bin/xvfb-run") ||
      run_process({"/usr/bin/python3", "-c", "import vtk"}).status != 0) {
    GTEST_SKIP() << "no xvfb or no VTK for Python";
  }
  const auto picture = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> words{"render",  run_.path(), "-o",      run_ / name,
                                   "--field", "pressure",  "--width", "400"};
    words.insert(words.end(), more.begin(), more.end());
    const ProcessResult result = post(words);
    EXPECT_EQ(result.status, 0) << result.err;
    return read_text(run_ / name);
  };
  const std::string all = picture("all.png", {}), bare = picture("bare.png", {"--no-colliders"});
  EXPECT_EQ(all.substr(1, 3), "PNG");
  EXPECT_NE(all, bare);
}

TEST_F(PostColliders, TheHistoryIsATableAgainstTheWay) {
  const ProcessResult result = post({"history", run_.path(), "--columns", "wall_force", "--against",
                                     "wall_displacement_x", "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_EQ(json["columns"], Json({"wall_displacement_x", "wall_force_x"}));
  EXPECT_EQ(json["units"]["wall_force_x"], "N/m");
  ASSERT_EQ(json["rows"].size(), 5u);
  for (const Json& row : json["rows"])
    EXPECT_NEAR(row[1].get<double>(), -10 * row[0].get<double>(), 1e-14);
}

TEST_F(PostColliders, TheHistoryHasDefaultsAndAPicture) {
  const std::string picture = run_ / "history.svg";
  const ProcessResult result = post({"history", run_.path(), "-o", picture});
  ASSERT_EQ(result.status, 0) << result.err;
  const std::string svg = read_text(picture);
  for (const char* words : {"Energy (J/m)", "Force on colliders (N/m)", "Time (s)"})
    EXPECT_NE(svg.find(words), std::string::npos) << words;
  EXPECT_EQ(svg.find("Momentum"), std::string::npos);  // zero throughout: left out
  const ProcessResult late = post({"history", run_.path(), "--from", "0.5", "--quiet"});
  EXPECT_EQ(std::count(late.out.begin(), late.out.end(), '\n'), 1 + 3);
  const ProcessResult wrong = post({"history", run_.path(), "--columns", "kinetic_energie"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("did you mean kinetic_energy?"), std::string::npos) << wrong.err;
}

}  // namespace
}  // namespace scree
