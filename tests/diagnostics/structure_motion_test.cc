#include "emmy/diagnostics/structure_motion.h"

#include <gtest/gtest.h>

#include "tests/support/structures.h"
#include "tests/support/test_run.h"

namespace emmy {
namespace {

TEST(ObserveNodeTest, AtTheStartIsAsDescribed) {
  const TestRun run(Tangle(), 1e-3);
  const PointMotion b = ObserveNode(run.model(), run.state(), 1);
  EXPECT_EQ(b.position, Vector3d(3.0, 2.5, 0.5));
  EXPECT_EQ(b.velocity, Vector3d(0.5, 0.0, 1.0));
}

TEST(ObserveNodeTest, ATiedNodeMovesWithItsBody) {
  ModelDescription model = ModelOf(PaperBox());
  NodeDescription corner = TestNode("corner", 2.0, {1.5, 1.0, 0.5});
  corner.velocity = MovesWith{"box"};
  model.nodes.push_back(corner);
  model.shared_points.push_back(
      {NodePoint{"corner"}, BodyPoint{"box", {1.5, 1.0, 0.5}}});
  TestRun run(model, 1e-3);
  ASSERT_TRUE(run.Advance(500));
  const PointMotion node = ObserveNode(run.model(), run.state(), 0);
  // Of x̄ + ξᵢ eᵢ.
  const auto& q = run.state().position.value;
  const auto& w = run.state().velocity.value;
  const Vector3d x = q.segment<3>(0) + 1.5 * q.segment<3>(3) + q.segment<3>(6) +
                     0.5 * q.segment<3>(9);
  const Vector3d v = w.segment<3>(0) + 1.5 * w.segment<3>(3) + w.segment<3>(6) +
                     0.5 * w.segment<3>(9);
  EXPECT_LE((node.position - x).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_LE((node.velocity - v).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(ObservePointTest, TheGroundDoesNotMove) {
  const TestRun run(Tangle(), 1e-3);
  Point ground;
  ground.ground = {1.0, 2.0, 3.0};
  const PointMotion motion = ObservePoint(run.model(), run.state(), ground);
  EXPECT_EQ(motion.position, Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(motion.velocity, Vector3d(0.0, 0.0, 0.0));
}

TEST(ObserveLineTest, StrainAndForceAreThoseOfTheEnds) {
  TestRun run(Tangle(), 1e-3);
  ASSERT_TRUE(run.Advance(100));
  for (size_t i = 0; i < run.model().lines().size(); ++i) {
    const ModelLine& line = run.model().lines()[i];
    const double length =
        (ObservePoint(run.model(), run.state(), line.ends[1]).position -
         ObservePoint(run.model(), run.state(), line.ends[0]).position)
            .norm();
    const double natural = line.element.natural_length();
    const double stiffness = line.element.stiffness();
    const LineObservation seen = ObserveLine(run.model(), run.state(), i);
    double strain = (length * length / (natural * natural) - 1.0) / 2.0;
    double force = stiffness * strain * length / natural;
    if (line.element.kind() == LineElement::Kind::kSpring) {
      strain = length / natural - 1.0;
      force = stiffness * (length - natural);
    } else if (line.element.kind() == LineElement::Kind::kCable &&
               strain < 0.0) {
      force = 0.0;
    }
    EXPECT_NEAR(seen.strain, strain, 1e-14) << line.name;
    EXPECT_NEAR(seen.force, force, 1e-14 * 4.0 * stiffness) << line.name;
  }
}

}  // namespace
}  // namespace emmy
