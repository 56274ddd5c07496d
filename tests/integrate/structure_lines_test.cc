// The passes over all lines against each line's element by itself.

#include "emmy/integrate/structure_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "emmy/model/model_builder.h"
#include "tests/support/random_source.h"
#include "tests/support/structures.h"

namespace emmy {
namespace {

constexpr double kTimeStep = 0.02;

// Trusses between nodes, before and after every other kind of line.
ModelDescription EveryKindOfLine() {
  ModelDescription model = Tangle();
  model.nodes.push_back(TestNode("c", 25.0, {2.0, 4.0, -1.0}));
  model.trusses.push_back(TestTruss("ca", NodePoint{"c"}, NodePoint{"a"}));
  model.trusses.push_back(TestTruss("bc", NodePoint{"b"}, NodePoint{"c"}));
  model.trusses.push_back(
      TestTruss("held", GroundPoint{{5.0, 5.0, 5.0}}, NodePoint{"c"}));
  return model;
}

class StructureLinesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    absl::StatusOr<BuiltModel> built = BuildModel(EveryKindOfLine());
    ASSERT_TRUE(built.ok()) << built.status();
    built_ = *std::move(built);
    structures_ = SplitIntoStructures(built_.model);
    ASSERT_EQ(structures_.size(), 1U);
    const Structure& structure = structures_[0];
    RandomSource random(7);
    for (Matrix3Xd* m : {&q0_, &q0_compensation_, &dq_}) {
      m->resize(3, structure.num_vectors());
      for (Eigen::Index v = 0; v < m->cols(); ++v) m->col(v) = random.Vector(1);
    }
    q0_compensation_ *= 1e-16;
    const auto strains =
        static_cast<Eigen::Index>(structure.strain_offsets.size());
    strain0_.resize(strains);
    strain0_compensation_.resize(strains);
    for (Eigen::Index s = 0; s < strains; ++s) {
      strain0_(s) = random.Uniform(0.05, 0.1);
      strain0_compensation_(s) = random.Uniform(-1e-18, 1e-18);
    }
  }

  // φ applied to columns of vectors.
  static Vector3d Difference(const Structure::Line& line, const Matrix3Xd& q) {
    Vector3d sum = Vector3d::Zero();
    for (const auto& [vector, weight] : line.terms) {
      sum += weight * q.col(vector);
    }
    return sum;
  }

  struct Expected {
    Vector3d mean;
    LineElement::Response response;
  };
  Expected Of(const Structure::Line& line) const {
    const Vector3d change = Difference(line, dq_);
    const Vector3d mean =
        (line.line->difference.ground + Difference(line, q0_)) +
        (Difference(line, q0_compensation_) + 0.5 * change);
    return {mean, line.line->element.Respond(strain0_(line.strain),
                                             strain0_compensation_(line.strain),
                                             mean.dot(change))};
  }

  BuiltModel built_;
  std::vector<Structure> structures_;
  Matrix3Xd q0_, q0_compensation_, dq_;
  VectorXd strain0_, strain0_compensation_;
};

TEST_F(StructureLinesTest, AddsTheImpulseOfEveryLineInOrder) {
  const Structure& structure = structures_[0];
  Matrix3Xd expected = Matrix3Xd::Zero(3, structure.num_vectors());
  VectorXd expected_size = VectorXd::Zero(structure.num_vectors());
  for (const Structure::Line& line : structure.lines) {
    const auto [mean, response] = Of(line);
    const Vector3d impulse = (kTimeStep * response.tension_factor) * mean;
    for (const auto& [vector, weight] : line.terms) {
      expected.col(vector) += weight * impulse;
      expected_size(vector) += std::abs(weight) * impulse.cwiseAbs().maxCoeff();
    }
  }
  WorkTeam team(1);
  StructureLines lines(structure);
  lines.Load(q0_, q0_compensation_);
  Matrix3Xd residual = Matrix3Xd::Zero(3, structure.num_vectors());
  VectorXd magnitude = VectorXd::Zero(structure.num_vectors());
  lines.AddImpulses(kTimeStep, dq_, strain0_, strain0_compensation_, &team,
                    &residual, &magnitude);
  EXPECT_EQ(residual, expected);
  EXPECT_EQ(magnitude, expected_size);
}

TEST_F(StructureLinesTest, AdvancesStrainsAndRespondsLikeTheElements) {
  const Structure& structure = structures_[0];
  WorkTeam team(1);
  StructureLines lines(structure);
  lines.Load(q0_, q0_compensation_);
  VectorXd increment = VectorXd::Zero(strain0_.size());
  lines.AdvanceStrains(dq_, strain0_, strain0_compensation_, &team, &increment);
  lines.Respond(dq_, strain0_, strain0_compensation_);
  for (size_t i = 0; i < structure.lines.size(); ++i) {
    const Structure::Line& line = structure.lines[i];
    const auto column = static_cast<Eigen::Index>(i);
    const auto [mean, response] = Of(line);
    EXPECT_EQ(increment(line.strain), response.increment) << i;
    EXPECT_EQ(Vector3d(lines.mean().col(column)), mean) << i;
    EXPECT_EQ(lines.tension()(column), response.tension_factor) << i;
    EXPECT_EQ(lines.derivative()(column), response.derivative) << i;
    // Sums of up to eight terms of size one, in another order.
    EXPECT_LE(
        (lines.End(dq_).col(column) - (mean + 0.5 * Difference(line, dq_)))
            .cwiseAbs()
            .maxCoeff(),
        8.0 * 8.0 * 0x1p-53)
        << i;
  }
}

}  // namespace
}  // namespace emmy
