// SPDX-License-Identifier: Apache-2.0
// The balance of scree post energy: the work of loads, body forces and moving colliders is counted,
// and nothing is lost where nothing can be.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "verification/support/process.hpp"
#include "verification/support/temporary_folder.hpp"

namespace scree {
namespace {

using Json = nlohmann::json;

constexpr double modulus = 1e6, density = 1000, width = 0.1, height = 0.4;

/// A column of elastic stuff, 0.1 x 0.4 m, between smooth walls and on a smooth floor.
/// Poisson's ratio 0: the modulus of the column is Young's.
std::string column(const std::string& more, const std::string& method = "",
                   const std::string& floor = "slip") {
  return R"([domain]
dimension = 2
lower = [0.0, 0.0]
upper = [0.1, 0.6]
cell_size = 0.025
[time]
end = 0.4
[material.stuff]
model = "hencky"
density = 1000
youngs_modulus = 1e6
poissons_ratio = 0.0
[body.column]
material = "stuff"
shape = { type = "box", lower = [0.0, 0.0], upper = [0.1, 0.4] }
[boundary]
x_min = "slip"
x_max = "slip"
y_min = ")" +
         floor + "\"\n[method]\n" + method +
         "\n[history]\nevery = 0.02\n[output]\nformat = \"none\"\n" + more;
}

class EnergyBalance : public testing::Test {
 protected:
  /// The facts of `scree post energy` after a run of the deck.
  Json facts(const std::string& deck) {
    write_text(folder_ / "deck.toml", deck);
    const ProcessResult run =
        run_process({SCREE_EXECUTABLE, "run", (folder_ / "deck.toml").string(), "-o",
                     (folder_ / "run").string(), "--overwrite", "--quiet"});
    EXPECT_EQ(run.status, 0) << run.err;
    const ProcessResult post =
        run_process({SCREE_EXECUTABLE, "post", "energy", (folder_ / "run").string(), "--json"});
    EXPECT_EQ(post.status, 0) << post.err;
    const Json json = Json::parse(post.out, nullptr, false);
    EXPECT_TRUE(json.is_object() && json["remarks"].empty()) << post.out;
    return json["facts"];
  }

  TemporaryFolder folder_;
};

// A pressure that grows slowly: the work is the energy of the column. Its strain e fulfils
// E e = -P exp(e), as P is a force per area at t = 0 and the law is Hencky's.
TEST_F(EnergyBalance, ATractionStoresItsWork) {
  const Json found =
      facts(column("[traction.top]\nbody = \"column\"\nfacing = [0.0, 1.0]\n"
                   "region = { type = \"box\", lower = [0.0, 0.39], upper = [0.1, 0.41] }\n"
                   "value = [\"0\", \"-1e4*(t/0.4-sin(2*pi*t/0.4)/(2*pi))\"]\n"));
  double strain = 0;
  for (int i = 0; i < 20; ++i) strain = -1e4 / modulus * std::exp(strain);
  const double expected = 0.5 * modulus * strain * strain * width * height;
  // 2 %: the load acts at the centres of the topmost particles, 1 % of the height below the top.
  EXPECT_NEAR(found["load_work"].get<double>(), expected, 0.02 * expected);
  EXPECT_NEAR(found["elastic"].get<double>(), expected, 0.02 * expected);
  // First order in the step over the time, and the transfers damp what remains of waves.
  EXPECT_NEAR(found["dissipated"].get<double>(), 0, 1e-3 * expected);
}

// A uniform body force on a body that touches nothing: all work is kinetic energy.
TEST_F(EnergyBalance, ABodyForceGivesSpeed) {
  const Json found = facts(column("", "body_force = [\"0\", \"0.5*sin(pi*t/0.4)\"]", "open"));
  const double speed = 0.5 * 0.4 / M_PI * 2, mass = density * width * height;
  const double expected = 0.5 * mass * speed * speed;
  // The force of a step is that of its start: an error of the sum over steps.
  EXPECT_NEAR(found["load_work"].get<double>(), expected, 1e-4 * expected);
  // Rounding: the work of a step is the mean of its powers at both ends, as the kinetic energy is.
  EXPECT_NEAR(found["dissipated"].get<double>(), 0, 1e-12 * expected);
}

// A plate that is pressed into the column by 4 mm.
TEST_F(EnergyBalance, AColliderStoresItsWork) {
  const double way = 4e-3;
  const Json found = facts(column(
      "[collider.plate]\nshape = { type = \"box\", lower = [-1.0, 0.4], upper = [2.0, 0.5] }\n"
      "velocity = [\"0\", \"-0.01*(1-cos(2*pi*t/0.4))\"]\ncontact = \"slip\"\n"));
  // The plate holds the nodes on its lower side, so the column below it is compressed by the way.
  const double strain = std::log(1 - way / height);
  const double expected = 0.5 * modulus * strain * strain * width * height;
  // 5 %: nodes of the two lattices lie at the plate's face and half a cell, 3 % of the height, off.
  EXPECT_NEAR(found["collider_work"].get<double>(), expected, 0.05 * expected);
  // First order in the step over the time; 4e-4 with half of the step.
  EXPECT_NEAR(found["dissipated"].get<double>(), 0, 2e-3 * expected);
}

}  // namespace
}  // namespace scree
