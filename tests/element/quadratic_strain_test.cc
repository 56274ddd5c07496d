#include "emmy/element/quadratic_strain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "emmy/element/ancf_rigid_body.h"
#include "tests/support/paper_box.h"
#include "tests/support/random_source.h"
#include "tests/support/roundoff_bound.h"
#include "tests/support/wide.h"

namespace emmy {
namespace {

// A step of the gradient vectors from e to e + Δe.
struct Regime {
  const char* name;
  double strain;  // ‖e − rotation‖
  double step;    // ‖Δe‖
  friend void PrintTo(const Regime& r, std::ostream* os) { *os << r.name; }
};

class QuadraticStrainTest : public ::testing::TestWithParam<Regime> {
 protected:
  static constexpr int kTrials = 200;

  struct Step {
    Matrix3d gradients;
    Matrix3d increment;
    Matrix3d mean() const { return gradients + 0.5 * increment; }
  };

  Step Random() {
    const double shift = GetParam().strain;
    Matrix3d e = Matrix3d::Identity() + random_.Entries<Matrix3d>(shift);
    const auto direction = random_.Direction<Vector9d>();
    const Matrix3d increment =
        GetParam().step * Eigen::Map<const Matrix3d>(direction.data());
    return {e, increment};
  }

  // The exact end and mean of the step, as both are rounded above.
  static WideMatrix3 End(const Step& step) {
    return step.gradients.cast<Wide>() + step.increment.cast<Wide>();
  }
  static WideVector6 Strain(const WideMatrix3& e) {
    WideVector6 strain;
    for (int i = 0; i < 3; ++i) {
      strain(i) = (Wide(e.col(i).dot(e.col(i))) - 1) / 2;
      strain(3 + i) = e.col(i).dot(e.col((i + 1) % 3));
    }
    return strain;
  }

  RandomSource random_{20250301};
};

// (QS-1): a product of at most six terms and the rounding of the mean, all
// relative to |ē| |Δe|: relative to the increment and not to the strain.
TEST_P(QuadraticStrainTest, IncrementIsTheDifferenceOfTheEndStrains) {
  for (int trial = 0; trial < kTrials; ++trial) {
    const Step step = Random();
    const Vector6d increment =
        AncfRigidBody::StrainIncrement(step.mean(), step.increment);
    const WideVector6 exact =
        Strain(End(step)) - Strain(step.gradients.cast<Wide>());
    EXPECT_LE(
        MaxAbs(increment.cast<Wide>() - exact),
        RoundoffBound(8, 2.0 * step.mean().norm() * step.increment.norm()))
        << "trial " << trial;
  }
}

// (QS-2): force times increment is the difference of the penalty energies.
TEST_P(QuadraticStrainTest, WorkOfTheStepIsTheChangeOfEnergy) {
  const AncfRigidBody box = PaperBoxElement(1e8);
  const Vector6d& b = box.penalty_stiffness();
  for (int trial = 0; trial < kTrials; ++trial) {
    const Step step = Random();
    const WideVector6 start = Strain(step.gradients.cast<Wide>());
    const Vector6d strain = start.cast<double>();
    const Vector6d increment =
        AncfRigidBody::StrainIncrement(step.mean(), step.increment);
    const Vector6d mean_strain = strain + 0.5 * increment;
    const Matrix3d force = box.InternalForce(step.mean(), mean_strain);
    // Multiplied and added without further rounding.
    Wide work = 0;
    Wide gain = 0;
    double magnitude = 0.0;
    for (int k = 0; k < 9; ++k) {
      work += Wide(force(k)) * Wide(step.increment(k));
    }
    const double size = step.mean().norm() * step.increment.norm();
    for (int k = 0; k < 6; ++k) {
      const Wide end = Wide(strain(k)) + Wide(increment(k));
      gain += Wide(b(k)) * (end * end - Wide(strain(k)) * strain(k)) / 2;
      // The products that make up the work, however much of it cancels.
      magnitude += b(k) * std::abs(mean_strain(k)) * 2.0 * size;
    }
    // 5 operations for the force's entries, 7 for Δε, 2 for ε̄.
    EXPECT_LE(std::abs(ToDouble(work - gain)), RoundoffBound(14, magnitude))
        << "trial " << trial;
  }
}

// Invariance under rotation: Σ ēᵢ × f̄ᵢ = 0.
TEST_P(QuadraticStrainTest, ForceHasNoMoment) {
  const AncfRigidBody box = PaperBoxElement(1e8);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Step step = Random();
    const Matrix3d mean = step.mean();
    const auto strain = random_.Entries<Vector6d>(1.0);
    const Matrix3d force = box.InternalForce(mean, strain);
    WideVector3 moment = WideVector3::Zero();
    double magnitude = 0.0;
    for (int i = 0; i < 3; ++i) {
      moment += WideVector3(mean.col(i).cast<Wide>())
                    .cross(WideVector3(force.col(i).cast<Wide>()));
    }
    for (int k = 0; k < 6; ++k) {
      magnitude += 2.0 * box.penalty_stiffness()(k) * std::abs(strain(k)) *
                   mean.squaredNorm();
    }
    // 4 operations for a force's entry: two products and two sums.
    EXPECT_LE(MaxAbs(moment), RoundoffBound(4, magnitude));
  }
}

INSTANTIATE_TEST_SUITE_P(Regimes, QuadraticStrainTest,
                         ::testing::Values(Regime{"Identical", 1e-3, 0.0},
                                           Regime{"NearRest", 1e-12, 1e-8},
                                           Regime{"SmallStep", 1e-6, 1e-3},
                                           Regime{"Strained", 0.3, 0.1},
                                           Regime{"LargeStep", 1e-3, 1.0},
                                           Regime{"TurnedInsideOut", 2.0, 5.0},
                                           Regime{"VeryLargeStep", 0.1, 100.0}),
                         [](const auto& regime) { return regime.param.name; });

// How the checks above fail: strain of the mean instead of mean strain, which
// agrees to second order and so passes where steps are small.
TEST(WrongQuadraticStrainTest, StrainOfTheMeanVectorsDoesNotDoTheWork) {
  const AncfRigidBody box = PaperBoxElement(1e8);
  RandomSource random(20250302);
  const Matrix3d e = Matrix3d::Identity() + random.Entries<Matrix3d>(0.1);
  const auto increment = random.Entries<Matrix3d>(1.0);
  const Matrix3d mean = e + 0.5 * increment;
  const auto work_error = [&](const Vector6d& strain) {
    const double work =
        box.InternalForce(mean, strain).cwiseProduct(increment).sum();
    return std::abs(work -
                    (box.PenaltyEnergy(AncfRigidBody::Strain(e + increment)) -
                     box.PenaltyEnergy(AncfRigidBody::Strain(e))));
  };
  const double scale = box.penalty_stiffness()(0);
  const Vector6d right = AncfRigidBody::Strain(e) +
                         0.5 * AncfRigidBody::StrainIncrement(mean, increment);
  EXPECT_LE(work_error(right), RoundoffBound(1000, scale));
  EXPECT_GT(work_error(AncfRigidBody::Strain(mean)), 1e-3 * scale);
}

TEST(QuadraticStrainFunctionsTest, NormalAndProductAreTheirFormulas) {
  const Vector3d a(1.0, 2.0, 3.0);
  const Vector3d da(0.5, 0.0, -1.0);
  const Vector3d b(0.0, 1.0, 4.0);
  const Vector3d db(2.0, 2.0, 2.0);
  EXPECT_EQ(NormalStrainIncrement(a, da), -2.5);
  EXPECT_EQ(ProductStrainIncrement(a, da, b, db), 12.0 - 4.0);
}

}  // namespace
}  // namespace emmy
