// What is wrong with nodes, elements, shared points and loads, and how
// BuildModel says so.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <limits>
#include <ostream>
#include <string>
#include <utility>
#include <variant>

#include "emmy/model/model_builder.h"
#include "tests/support/paper_box.h"
#include "tests/support/structures.h"

namespace emmy {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A resting box and two nodes with mass, joined by a truss.
ModelDescription Sound() {
  RigidBodyDescription box = PaperBox();
  box.angular_velocity.setZero();
  ModelDescription model = ModelOf(box);
  model.nodes = {TestNode("a", 1.0, {2.0, 0.0, 0.0}),
                 TestNode("b", 1.0, {3.0, 0.0, 0.0})};
  model.trusses = {TestTruss("truss", NodePoint{"a"}, NodePoint{"b"})};
  return model;
}

// Two boxes side by side, joined where they touch.
ModelDescription TwoBoxes(Formulation formulation = Formulation::kAncf) {
  RigidBodyDescription left = PaperBox(formulation);
  left.angular_velocity.setZero();
  RigidBodyDescription right = left;
  right.name = "right";
  right.position = {3.0, 0.0, 0.0};
  ModelDescription model = ModelOf(left);
  model.rigid_bodies.push_back(right);
  model.shared_points.push_back({BodyPoint{"box", {1.5, 0.0, 0.0}},
                                 BodyPoint{"right", {-1.5, 0.0, 0.0}}});
  return model;
}

TEST(StructureTest, SoundModelsAreAccepted) {
  EXPECT_TRUE(BuildModel(Sound()).ok());
  EXPECT_TRUE(BuildModel(TwoBoxes()).ok());
}

struct Mistake {
  const char* name;
  std::function<void(ModelDescription&)> make;
  const char* place;   // How the message begins.
  const char* reason;  // What it says.
  friend void PrintTo(const Mistake& m, std::ostream* os) { *os << m.name; }
};

class StructureMistakeTest : public ::testing::TestWithParam<Mistake> {};

TEST_P(StructureMistakeTest, IsRejectedWithTheItemAndTheReason) {
  ModelDescription model = Sound();
  GetParam().make(model);
  const auto built = BuildModel(model);
  ASSERT_FALSE(built.ok());
  EXPECT_EQ(built.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(
      std::string(built.status().message()),
      AllOf(StartsWith(GetParam().place), HasSubstr(GetParam().reason)));
}

INSTANTIATE_TEST_SUITE_P(
    Mistakes, StructureMistakeTest,
    ::testing::Values(
        Mistake{"ZeroLengthTruss",
                [](auto& m) { m.nodes[1].position = m.nodes[0].position; },
                "/trusses/0/ends: ", "got a distance of 0"},
        Mistake{"TrussFromAPointToItself",
                [](auto& m) {
                  m.trusses[0].ends[1] = m.trusses[0].ends[0];
                  m.trusses[0].length = 1.0;
                },
                "/trusses/0/ends: ", "two points that can move apart"},
        Mistake{"NegativeArea", [](auto& m) { m.trusses[0].area = -1.0; },
                "/trusses/0/area: ", "got -1"},
        Mistake{"MassTooSmallForItsProducts",
                [](auto& m) { m.trusses[0].density = 1e-300; },
                "/trusses/0: ", "a mass of 0 or a finite number >= 1e-90 [kg]"},
        Mistake{"NegativeDensity", [](auto& m) { m.trusses[0].density = -1.0; },
                "/trusses/0/density: ", "got -1"},
        Mistake{"NoStiffness",
                [](auto& m) { m.trusses[0].young_modulus = 0.0; },
                "/trusses/0/young_modulus: ", "got 0"},
        Mistake{"NoSuchBody",
                [](auto& m) {
                  m.trusses[0].ends[0] = BodyPoint{"bax", Vector3d::Zero()};
                },
                "/trusses/0/ends/0/body: ", "got \"bax\""},
        Mistake{"NoSuchNode",
                [](auto& m) { m.trusses[0].ends[1] = NodePoint{"c"}; },
                "/trusses/0/ends/1/node: ", "got \"c\""},
        Mistake{"BodyGivenAsNode",
                [](auto& m) { m.trusses[0].ends[1] = NodePoint{"box"}; },
                "/trusses/0/ends/1/node: ", "the name of a node"},
        Mistake{"NameTwice", [](auto& m) { m.nodes[1].name = "box"; },
                "/nodes/1/name: ", "which is the name of /rigid_bodies/0"},
        Mistake{"NegativeMass", [](auto& m) { m.nodes[0].mass = -1.0; },
                "/nodes/0/mass: ", "got -1"},
        Mistake{"MovesWithNobody",
                [](auto& m) { m.nodes[0].velocity = MovesWith{"nobody"}; },
                "/nodes/0/velocity/moves_with: ", "got \"nobody\""},
        Mistake{"FixedNodeThatMoves",
                [](auto& m) {
                  m.nodes[0].fixed = true;
                  m.nodes[0].velocity = Vector3d(1.0, 0.0, 0.0);
                },
                "/nodes/0/velocity: ", "zero for a fixed node"},
        Mistake{"MasslessNodeAlone",
                [](auto& m) {
                  m.nodes.push_back(TestNode("c", 0.0, {9.0, 9.0, 9.0}));
                },
                "/nodes/2: node \"c\"",
                "must have mass or be attached to something, got neither"},
        Mistake{"MasslessNodeOnMasslessElements",
                [](auto& m) {
                  m.nodes[1].mass = 0.0;
                  m.trusses[0].density = 0.0;
                },
                "/nodes/1: node \"b\"", "the mass matrix is singular"},
        Mistake{"SharedPointsApart",
                [](auto& m) {
                  m.shared_points.push_back(
                      {NodePoint{"a"}, BodyPoint{"box", {1.5, 0.0, 0.0}}});
                },
                "/shared_points/0: ", "got a gap of 0.5 m"},
        Mistake{"SharedPointsThatMoveApart",
                [](auto& m) {
                  m.nodes[0].velocity = Vector3d(0.0, 0.25, 0.0);
                  m.shared_points.push_back(
                      {NodePoint{"a"}, BodyPoint{"box", {2.0, 0.0, 0.0}}});
                },
                "/shared_points/0: must move alike", "0.25 m/s apart"},
        Mistake{"NoDegreeOfFreedom",
                [](auto& m) {
                  m.rigid_bodies.clear();
                  m.trusses.clear();
                  m.nodes[0].fixed = true;
                  m.nodes[1].fixed = true;
                },
                "", "degree of freedom"},
        Mistake{
            "ForceThatIsNoNumber",
            [](auto& m) {
              m.loads.push_back(ForceLoad{NodePoint{"a"}, {0.0, kNan, 0.0}});
            },
            "/loads/0/force", "finite"},
        Mistake{"TorqueOnNobody",
                [](auto& m) {
                  m.loads.push_back(TorqueLoad{"nobody", {0.0, 0.0, 1.0}});
                },
                "/loads/0/body: ", "got \"nobody\""},
        Mistake{"SpringWithoutStiffness",
                [](auto& m) {
                  m.springs.push_back(
                      {"spring", {NodePoint{"a"}, NodePoint{"b"}}, 0.0, 1.0});
                },
                "/springs/0/stiffness: ", "got 0"}),
    [](const auto& mistake) { return mistake.param.name; });

TEST(SharedPointTest, RedundantPointsOfAHingeAreDropped) {
  ModelDescription hinge = TwoBoxes();
  for (const double y : {-0.5, 0.5, 0.25}) {
    hinge.shared_points.push_back(
        {BodyPoint{"box", {1.5, y, 0.0}}, BodyPoint{"right", {-1.5, y, 0.0}}});
  }
  const auto built = BuildModel(hinge);
  ASSERT_TRUE(built.ok()) << built.status().message();
  EXPECT_EQ(built->model.constraints().size(), 2U);
  EXPECT_EQ(built->model.degrees_of_freedom(), 24 - 6);
}

TEST(SharedPointTest, AnInconsistentThirdPointIsRejectedWithTheGap) {
  ModelDescription hinge = TwoBoxes();
  hinge.shared_points.push_back({BodyPoint{"box", {1.5, 0.5, 0.0}},
                                 BodyPoint{"right", {-1.5, 0.5, 0.125}}});
  const auto built = BuildModel(hinge);
  ASSERT_FALSE(built.ok());
  EXPECT_THAT(std::string(built.status().message()),
              AllOf(StartsWith("/shared_points/1: must coincide"),
                    HasSubstr("a gap of 0.125 m")));
}

TEST(SharedPointTest, AGapThroughAChainOfNodesIsFound) {
  ModelDescription model = TwoBoxes();
  model.shared_points.clear();
  NodeDescription node = TestNode("pin", 0.0, {1.5, 0.0, 0.0});
  model.nodes.push_back(node);
  node.name = "other";
  model.nodes.push_back(node);
  model.shared_points = {
      {NodePoint{"pin"}, BodyPoint{"box", {1.5, 0.0, 0.0}}},
      {NodePoint{"pin"}, NodePoint{"other"}},
      {NodePoint{"other"}, BodyPoint{"right", {-1.5, 0.25, 0.0}}}};
  const auto built = BuildModel(model);
  ASSERT_FALSE(built.ok());
  EXPECT_THAT(
      std::string(built.status().message()),
      AllOf(StartsWith("/shared_points/2: "), HasSubstr("a gap of 0.25 m")));
}

TEST(SharedPointTest, OfConventionalBodiesBecomesAJoint) {
  const auto built = BuildModel(TwoBoxes(Formulation::kConventional));
  ASSERT_TRUE(built.ok()) << built.status().message();
  const Model& model = built->model;
  ASSERT_EQ(model.joints().size(), 1U);
  EXPECT_EQ(model.joints()[0].name, "/shared_points/0");
  EXPECT_EQ(model.joints()[0].num_held, 3);
  EXPECT_FALSE(model.joints()[0].to_ground());
  EXPECT_TRUE(model.constraints().empty());
  EXPECT_EQ(model.degrees_of_freedom(), 12 - 3);
  EXPECT_EQ(built->state.multiplier.next.size(), 3);
}

TEST(SharedPointTest, OfConventionalBodiesMustMeetAndMoveAlike) {
  ModelDescription model = TwoBoxes(Formulation::kConventional);
  std::get<BodyPoint>(model.shared_points[0][1]).point(1) += 0.25;
  EXPECT_THAT(
      std::string(BuildModel(model).status().message()),
      AllOf(StartsWith("/shared_points/0: "), HasSubstr("a gap of 0.25 m")));
  model = TwoBoxes(Formulation::kConventional);
  model.rigid_bodies[1].velocity(2) += 0.125;
  EXPECT_THAT(std::string(BuildModel(model).status().message()),
              AllOf(StartsWith("/shared_points/0: must move alike"),
                    HasSubstr("0.125 m/s apart")));
}

// Within what is allowed, the second point is placed where the first one is.
TEST(SharedPointTest, OfConventionalBodiesLosesItsGapWithinTheAgreement) {
  ModelDescription model = TwoBoxes(Formulation::kConventional);
  std::get<BodyPoint>(model.shared_points[0][1]).point(1) += 1e-10;
  const auto built = BuildModel(model);
  ASSERT_TRUE(built.ok()) << built.status().message();
  const ModelJoint& joint = built->model.joints()[0];
  EXPECT_NEAR(joint.points[1].xi(1) - joint.points[0].xi(1), 0.0, 1e-15);
}

TEST(SharedPointTest, OfAConventionalBodyAndTheGroundHoldsTheBody) {
  for (const bool ground_first : {false, true}) {
    ModelDescription model = ModelOf(PaperBox(Formulation::kConventional));
    model.rigid_bodies[0].angular_velocity.setZero();
    std::array<PointDescription, 2> pair = {BodyPoint{"box", {1.5, 0.0, 0.0}},
                                            GroundPoint{{1.5, 0.0, 0.0}}};
    if (ground_first) std::swap(pair[0], pair[1]);
    model.shared_points.push_back(pair);
    const auto built = BuildModel(model);
    ASSERT_TRUE(built.ok()) << built.status().message();
    ASSERT_EQ(built->model.joints().size(), 1U);
    EXPECT_TRUE(built->model.joints()[0].to_ground());
    EXPECT_EQ(built->model.degrees_of_freedom(), 3);
  }
}

TEST(SharedPointTest, OfAConventionalAndAnAncfBodyIsNotSupportedAndSaysSo) {
  ModelDescription model = TwoBoxes(Formulation::kConventional);
  model.rigid_bodies[1].formulation = Formulation::kAncf;
  model.rigid_bodies[1].penalty = 1e10;
  const auto built = BuildModel(model);
  EXPECT_EQ(built.status().code(), absl::StatusCode::kUnimplemented);
  EXPECT_THAT(std::string(built.status().message()),
              AllOf(StartsWith("/shared_points/0: body \"right\""),
                    HasSubstr("not supported yet")));
}

TEST(SharedPointTest, ANodeOnAConventionalBodyMustBeMassless) {
  ModelDescription model = TwoBoxes(Formulation::kConventional);
  model.nodes.push_back(TestNode("pin", 0.0, {1.5, 0.0, 0.0}));
  model.nodes[0].velocity = MovesWith{"box"};
  model.shared_points = {
      {NodePoint{"pin"}, BodyPoint{"box", {1.5, 0.0, 0.0}}},
      {NodePoint{"pin"}, BodyPoint{"right", {-1.5, 0.0, 0.0}}}};
  const auto built = BuildModel(model);
  ASSERT_TRUE(built.ok()) << built.status().message();
  EXPECT_EQ(built->model.joints().size(), 1U);
  EXPECT_TRUE(built->model.nodes()[0].point.conventional_body.has_value());
  model.nodes[0].mass = 2.0;
  EXPECT_THAT(
      std::string(BuildModel(model).status().message()),
      AllOf(StartsWith("/nodes/0/mass: must be 0 [kg]"), HasSubstr("got 2")));
}

}  // namespace
}  // namespace emmy
