#include "emmy/integrate/structure.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "emmy/model/model_builder.h"
#include "tests/support/structures.h"

namespace emmy {
namespace {

class StructureTest : public ::testing::Test {
 protected:
  // Structures refer to the model, which is kept here.
  const std::vector<Structure>& Split(const ModelDescription& description) {
    absl::StatusOr<BuiltModel> built = BuildModel(description);
    EXPECT_TRUE(built.ok()) << built.status();
    model_ = std::make_unique<const Model>(std::move(built->model));
    structures_ = SplitIntoStructures(*model_);
    return structures_;
  }

 private:
  std::unique_ptr<const Model> model_;
  std::vector<Structure> structures_;
};

TEST_F(StructureTest, ABodyToWhichNothingIsAttachedIsFree) {
  ModelDescription model = BoxWithTruss();
  RigidBodyDescription other = PaperBox();
  other.name = "other";
  model.rigid_bodies.push_back(other);
  const std::vector<Structure>& structures = Split(model);
  ASSERT_EQ(structures.size(), 2U);
  EXPECT_FALSE(structures[0].is_free_body());
  EXPECT_TRUE(structures[1].is_free_body());
  EXPECT_EQ(structures[1].bodies[0].body->name, "other");
}

TEST_F(StructureTest, WhatAnElementOrAJointConnectsIsOne) {
  const std::vector<Structure>& structures = Split(Tangle());
  ASSERT_EQ(structures.size(), 1U);
  EXPECT_EQ(structures[0].bodies.size(), 3U);
  EXPECT_EQ(structures[0].lines.size(), 4U);
  EXPECT_EQ(structures[0].constraints.size(), 1U);
  EXPECT_EQ(structures[0].num_vectors(), 3 * 4 + 2);
  EXPECT_FALSE(structures[0].is_grounded);
}

TEST_F(StructureTest, StrainsOfLinesFollowThoseOfBodies) {
  const Structure& structure = Split(Tangle())[0];
  int expected = 0;
  for (const Structure::Body& body : structure.bodies) {
    EXPECT_EQ(body.first_strain, expected);
    expected += AncfRigidBody::kNumStrains;
  }
  for (const Structure::Line& line : structure.lines) {
    EXPECT_EQ(line.strain, expected++);
  }
  EXPECT_EQ(structure.strain_offsets.size(), static_cast<size_t>(expected));
}

TEST_F(StructureTest, OnlyTheGradientVectorsDoNotTranslate) {
  const Structure& structure = Split(BoxWithTruss())[0];
  ASSERT_EQ(structure.num_vectors(), 5);
  EXPECT_EQ(structure.translates,
            (std::vector<bool>{true, false, false, false, true}));
}

TEST_F(StructureTest, AnEndFixedInSpaceGroundsIt) {
  ModelDescription model = BoxWithTruss();
  model.trusses.push_back(
      TestTruss("stay", NodePoint{"tip"}, GroundPoint{{1.5, 1.0, 3.0}}));
  EXPECT_TRUE(Split(model)[0].is_grounded);
  EXPECT_FALSE(Split(BoxWithTruss())[0].is_grounded);
}

TEST_F(StructureTest, ConventionalBodiesAndWhatHangsOnThemAreLeftOut) {
  EXPECT_TRUE(Split(BoxWithTruss(Formulation::kConventional)).empty());
}

// A truss's mass is in the matrix of the whole: 1/3 at each end, 1/6 between.
TEST_F(StructureTest, EachPairOfMassesIsListedOnce) {
  ModelDescription model;
  model.nodes = {TestNode("a", 1.0, {0.0, 0.0, 0.0}),
                 TestNode("b", 2.0, {1.0, 0.0, 0.0})};
  model.trusses.push_back(TestTruss("ab", NodePoint{"a"}, NodePoint{"b"}));
  const Structure& structure = Split(model)[0];
  const double mass = 0.27;
  ASSERT_EQ(structure.masses.size(), 3U);
  for (const Structure::Mass& entry : structure.masses) {
    EXPECT_GE(entry.row, entry.column);
    const double own = entry.row == 0 ? 1.0 : 2.0;
    const double expected =
        entry.row == entry.column ? own + mass / 3.0 : mass / 6.0;
    EXPECT_NEAR(entry.mass, expected, 4e-16 * expected);
  }
}

}  // namespace
}  // namespace emmy
