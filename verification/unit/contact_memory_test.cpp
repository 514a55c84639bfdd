// SPDX-License-Identifier: Apache-2.0
#include "solver/boundary/contact_memory.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "solver/boundary/collider.hpp"
#include "solver/io/memory_archive.hpp"
#include "verification/support/meshes.hpp"
#include "verification/support/temporary_folder.hpp"

namespace scree {
namespace {

/// A ball of triangles with this velocity.
ColliderSpec ball(const TemporaryFolder& folder, const std::string& vx, const std::string& vz) {
  write_text(folder / "ball.stl", testing::binary_stl(testing::icosphere(0.5, 3)));
  ColliderSpec spec;
  spec.name = "ball";
  spec.shape.kind = ShapeKind::mesh;
  spec.shape.file = (folder / "ball.stl").string();
  for (Formula& formula : spec.velocity) formula.text = "0";
  spec.velocity[0].text = vx;
  spec.velocity[2].text = vz;
  spec.contact = {ContactType::friction, 0.3};
  return spec;
}

/// Points about the ball, the same ones at every time, as nodes are.
std::vector<std::array<double, 3>> nodes() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<std::array<double, 3>> points(500);
  for (auto& x : points)
    for (double& c : x) c = uniform(random);
  return points;
}

void compare(const Collider& collider, const std::array<double, 3>& x, ContactMemory& memory) {
  Vec3<double> normal;
  const bool touches = collider.touches(x.data(), memory, normal);
  ASSERT_EQ(touches, collider.touches(x.data()));
  if (!touches) return;
  const Vec3<double> exact = collider.normal(x.data());
  for (int a = 0; a < 3; ++a) ASSERT_EQ(normal[a], exact[a]);
}

// What is remembered saves questions, but never changes an answer: not by a bit.
TEST(ContactMemory, AMovingColliderAnswersAsIfItWereAsked) {
  const TemporaryFolder folder;
  Collider collider(ball(folder, "cos(9*t)", "0.4"), 3, 0.1);
  EXPECT_TRUE(collider.costly());
  const auto points = nodes();
  std::vector<ContactMemory> memory(points.size());
  int touched = 0;
  for (int step = 0; step < 60; ++step) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      compare(collider, points[i], memory[i]);
      touched += collider.touches(points[i].data());
    }
    collider.set_step(0.02 * step, 0.02);
    collider.advance(0.02);
  }
  EXPECT_GT(touched, 100);
}

TEST(ContactMemory, BlocksThatAreClearHoldNoNodeThatTouches) {
  const TemporaryFolder folder;
  Collider collider(ball(folder, "1", "-1"), 3, 0.1);
  const auto points = nodes();
  ContactMemory center;
  const double middle[3] = {1.2, 0.1, -1.2}, reach = 0.3;
  bool clear_once = false, near_once = false;
  for (int step = 0; step < 60; ++step) {
    const bool clear = collider.clear_of(middle, reach, center);
    clear_once = clear_once || clear;
    near_once = near_once || !clear;
    for (const auto& p : points) {
      double x[3];
      for (int a = 0; a < 3; ++a) x[a] = middle[a] + p[std::size_t(a)] * reach / std::sqrt(3.0);
      EXPECT_FALSE(clear && collider.touches(x));
    }
    collider.set_step(0.02 * step, 0.02);
    collider.advance(0.02);
  }
  EXPECT_TRUE(clear_once && near_once);
}

TEST(ContactMemory, ALoadedStateIsANewPlace) {
  const TemporaryFolder folder;
  Collider collider(ball(folder, "1", "0"), 3, 0.1);
  const double x[3] = {0.9, 0, 0};
  ContactMemory memory;
  Vec3<double> normal;
  EXPECT_FALSE(collider.touches(x, memory, normal));
  MemoryArchive archive;
  Collider moved(ball(folder, "1", "0"), 3, 0.1);
  moved.set_step(0, 0.9);
  moved.advance(0.9);
  moved.save(archive);
  collider.load(archive);
  EXPECT_TRUE(collider.touches(x, memory, normal));
}

}  // namespace
}  // namespace scree
