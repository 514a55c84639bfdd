// SPDX-License-Identifier: Apache-2.0
//
// What pore pressure may change at a pair of nodes at a wall: a ghost (record 0) below a face
// normal to y and its image (record 1).
#include "solver/coupling/node_constraints.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "solver/grid/face_fold.hpp"

namespace scree {
namespace {

constexpr double ghost_mass = 0.5, image_mass = 1.5;

struct PairAtWall {
  std::array<int, 2> sign;        ///< of the ghost's change of velocity in the image's
  std::array<double, 2> inverse;  ///< of the group's mass
};

PairAtWall pair_at_wall(FaceType type, NoSlip no_slip, PairState state,
                        std::vector<double> velocity) {
  Faces<2> faces;
  faces.type[1][0] = type;
  faces.no_slip = no_slip;
  FacePairs<2> pairs;
  pairs[1].push_back({0, 1, 0});
  std::array<std::vector<char>, 2> folded;
  folded[1].push_back(char(state));
  GridDecisions<2> decisions;
  decisions.faces = &faces;
  decisions.pairs = &pairs;
  decisions.folded = &folded;
  NodeConstraints<2> constraints;
  constraints.masses() = {ghost_mass, image_mass};
  const auto nowhere = [](std::int64_t) { return std::array<double, 3>{}; };
  constraints.find(decisions, {velocity.data(), 2}, {}, nowhere, 0.0);
  EXPECT_EQ(constraints.groups().size(), 1U);
  const NodeGroup<2>& group = constraints.groups().at(0);
  EXPECT_EQ(group.root, 1);
  EXPECT_EQ(group.end - group.begin, 2);
  const auto& ghost = constraints.members().at(std::size_t(group.begin) + 1);
  return {{ghost.sign[0], ghost.sign[1]}, {group.inverse[0][0], group.inverse[1][1]}};
}

const std::vector<double> moving{-1, 2, 1, -2};  // ghost, image
const std::vector<double> resting{0, 0, 0, 0};
constexpr double both = 1 / (ghost_mass + image_mass);

TEST(NodeConstraints, APairThatHoldsAtTheFaceKeepsAnOddVelocity) {
  for (const FaceType type : {FaceType::sticky, FaceType::friction}) {
    for (const auto& velocity : {moving, resting}) {
      const PairAtWall pair = pair_at_wall(type, NoSlip::face, pair_follows, velocity);
      EXPECT_EQ(pair.sign, (std::array<int, 2>{-1, -1}));
      EXPECT_EQ(pair.inverse, (std::array<double, 2>{both, both}));
    }
  }
}

TEST(NodeConstraints, APairThatSlidesMovesAsAtAMirror) {
  const PairAtWall mirror = pair_at_wall(FaceType::slip, NoSlip::face, pair_follows, moving);
  EXPECT_EQ(mirror.sign, (std::array<int, 2>{1, -1}));
  const PairAtWall pair = pair_at_wall(FaceType::friction, NoSlip::face, pair_slides, moving);
  EXPECT_EQ(pair.sign, mirror.sign);
  EXPECT_EQ(pair.inverse, (std::array<double, 2>{both, both}));
}

TEST(NodeConstraints, APairHeldAtNodesLosesTheGhostOrItsTangentialFreedom) {
  const PairAtWall sticky = pair_at_wall(FaceType::sticky, NoSlip::node, pair_follows, moving);
  EXPECT_EQ(sticky.sign, (std::array<int, 2>{0, -1}));
  EXPECT_EQ(sticky.inverse, (std::array<double, 2>{1 / image_mass, both}));
  const PairAtWall stuck = pair_at_wall(FaceType::friction, NoSlip::node, pair_follows, resting);
  EXPECT_EQ(stuck.sign, (std::array<int, 2>{1, -1}));
  EXPECT_EQ(stuck.inverse, (std::array<double, 2>{0, both}));
}

}  // namespace
}  // namespace scree
