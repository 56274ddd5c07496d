#include "emmy/model/joint_rank.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/paper_box.h"

namespace emmy {
namespace {

using ::testing::ElementsAre;

ModelBody Box(const std::string& name) {
  return {.name = name, .element = ConventionalRigidBody(PaperBoxInertia())};
}

Point On(size_t body, const Vector3d& xi) {
  Point point;
  point.conventional_body = body;
  point.xi = xi;
  return point;
}

Point Ground(const Vector3d& place) {
  Point point;
  point.ground = place;
  return point;
}

ModelJoint Between(const Point& first, const Point& second) {
  return {.name = "joint", .points = {first, second}};
}

std::vector<int> Held(const std::vector<ModelJoint>& joints) {
  std::vector<int> held;
  for (const ModelJoint& joint : joints) held.push_back(joint.num_held);
  return held;
}

const std::vector<Matrix3d>& NoTurn() {
  static const auto* const turns =
      new std::vector<Matrix3d>(4, Matrix3d::Identity());
  return *turns;
}

TEST(IndependentJointsTest, ASphericalJointHoldsAllDirections) {
  const std::vector<ModelJoint> joints = IndependentJoints(
      {Box("a"), Box("b")}, NoTurn(),
      {Between(On(0, {1.5, 0.2, 0.1}), On(1, {-1.5, 0.0, 0.3}))});
  EXPECT_THAT(Held(joints), ElementsAre(3));
  EXPECT_EQ(joints[0].held, Matrix3d::Identity());
}

TEST(IndependentJointsTest, AHingeHoldsItsAxisOnce) {
  const std::vector<ModelJoint> joints = IndependentJoints(
      {Box("a"), Box("b")}, NoTurn(),
      {Between(On(0, {1.5, 0.0, -0.5}), On(1, {-1.5, 0.0, -0.5})),
       Between(On(0, {1.5, 0.0, 0.5}), On(1, {-1.5, 0.0, 0.5})),
       Between(On(0, {1.5, 0.0, 0.1}), On(1, {-1.5, 0.0, 0.1}))});
  EXPECT_THAT(Held(joints), ElementsAre(3, 2));
  const Matrix3d across = Vector3d(1.0, 1.0, 0.0).asDiagonal();
  EXPECT_LE((joints[1].held - across).cwiseAbs().maxCoeff(), 1e-15);
}

// The projection is in the axes of the first body.
TEST(IndependentJointsTest, TheAxisTurnsWithTheFirstBody) {
  const Matrix3d turn =
      Eigen::AngleAxisd(0.5 * M_PI, Vector3d::UnitX()).toRotationMatrix();
  const std::vector<ModelJoint> joints = IndependentJoints(
      {Box("a"), Box("b")}, {turn, Matrix3d::Identity()},
      {Between(On(0, {1.5, -0.5, 0.0}), On(1, {-1.5, 0.0, -0.5})),
       Between(On(0, {1.5, 0.5, 0.0}), On(1, {-1.5, 0.0, 0.5}))});
  EXPECT_THAT(Held(joints), ElementsAre(3, 2));
  const Matrix3d across = Vector3d(1.0, 0.0, 1.0).asDiagonal();
  EXPECT_LE((joints[1].held - across).cwiseAbs().maxCoeff(), 1e-15);
}

// Three points on the ground hold all: 3 + 2 + 1 directions.
TEST(IndependentJointsTest, ThreePointsOnTheGroundHoldABody) {
  const std::vector<ModelJoint> joints =
      IndependentJoints({Box("a")}, NoTurn(),
                        {Between(On(0, {1.0, 0.0, 0.0}), Ground({1, 0, 0})),
                         Between(On(0, {0.0, 1.0, 0.0}), Ground({0, 1, 0})),
                         Between(On(0, {0.0, 0.0, 0.5}), Ground({0, 0, 0.5})),
                         Between(On(0, {1.0, 1.0, 0.5}), Ground({1, 1, 0.5}))});
  EXPECT_THAT(Held(joints), ElementsAre(3, 2, 1));
}

// A chain beside a hinge, and one that a second point on the ground closes.
TEST(IndependentJointsTest, OnlyLoopsHoldADirectionTwice) {
  const Vector3d right(1.5, 0.0, 0.0);
  const std::vector<ModelJoint> open = {Between(On(0, right), On(1, -right)),
                                        Between(On(1, right), Ground(right)),
                                        Between(On(2, right), On(3, -right))};
  const std::vector<ModelBody> bodies = {Box("a"), Box("b"), Box("c"),
                                         Box("d")};
  EXPECT_THAT(Held(IndependentJoints(bodies, NoTurn(), open)),
              ElementsAre(3, 3, 3));
  std::vector<ModelJoint> closed = open;
  closed.push_back(Between(On(2, {1.5, 0.0, 0.5}), On(3, {-1.5, 0.0, 0.5})));
  closed.push_back(Between(On(0, -right), Ground(-right)));
  EXPECT_THAT(Held(IndependentJoints(bodies, NoTurn(), closed)),
              ElementsAre(3, 3, 3, 2, 2));
}

// By counts a linkage of four hinges, 24 − 20 = 4 directions, could not move
// but as a whole; it has 7, for three are held twice.
TEST(IndependentJointsTest, ALinkageOfHingesMoves) {
  std::vector<ModelBody> bodies;
  std::vector<ModelJoint> joints;
  for (size_t i = 0; i < 4; ++i) {
    bodies.push_back(Box(std::to_string(i)));
    // Corners at the ends of each side, in its own axes.
    const bool upright = i % 2 == 0;
    const double sign = i < 2 ? 1.0 : -1.0;
    const Vector3d leaving = upright ? Vector3d(0.0, sign * 1.5, 0.0)
                                     : Vector3d(-sign * 1.5, 0.0, 0.0);
    const double next_sign = (i + 1) % 4 < 2 ? 1.0 : -1.0;
    const Vector3d entering = upright ? Vector3d(next_sign * 1.5, 0.0, 0.0)
                                      : Vector3d(0.0, -next_sign * 1.5, 0.0);
    for (const double z : {-0.5, 0.5}) {
      const Vector3d up(0.0, 0.0, z);
      joints.push_back(
          Between(On(i, leaving + up), On((i + 1) % 4, entering + up)));
    }
  }
  int held = 0;
  for (const ModelJoint& joint : IndependentJoints(bodies, NoTurn(), joints)) {
    held += joint.num_held;
  }
  EXPECT_EQ(24 - held, 7);
}

// A row of two boxes between two fixed points holds its length twice, but only
// while it is straight.
TEST(IndependentJointsTest, AStraightRowHoldsItsLengthOnce) {
  EXPECT_THAT(Held(IndependentJoints(
                  {Box("a"), Box("b")}, NoTurn(),
                  {Between(On(0, {-1.5, 0.0, 0.0}), Ground({-3.0, 0.0, 0.0})),
                   Between(On(0, {1.5, 0.0, 0.0}), On(1, {-1.5, 0.0, 0.0})),
                   Between(On(1, {1.5, 0.0, 0.0}), Ground({3.0, 0.0, 0.0}))})),
              ElementsAre(3, 3, 2));
}

}  // namespace
}  // namespace emmy
