// The motion depends on its data without a break where its formulas change:
// across the separatrix, at the axes, and where moments become equal.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/exact/regimes.h"

namespace emmy::exact {
namespace {

// A family of starts; size 0 is the special case, solved by other formulas.
struct Approach {
  const char* name;
  Polhode limit;   // At size 0,
  Polhode nearby;  // and at every size > 0.
  Vector3<double> moments;
  Vector3<double> moments_change;
  Vector3<double> omega;
  Vector3<double> omega_change;

  friend void PrintTo(const Approach& a, std::ostream* os) { *os << a.name; }

  FreeRigidBody<Quad> Body(const Quad& size) const {
    FreeRigidBodyStart<Quad> start;
    const Vector3<Quad> j =
        moments.cast<Quad>() + size * moments_change.cast<Quad>();
    start.inertia = j.asDiagonal();
    start.angular_velocity =
        omega.cast<Quad>() + size * omega_change.cast<Quad>();
    return FreeRigidBody<Quad>::Create(start).value();
  }
};

class FreeRigidBodyLimitsTest : public ::testing::TestWithParam<Approach> {};

// The solution is differentiable in its data, so |x(size) − x(0)| / size tends
// to a constant: over ten decades it may change by the larger size, times
// the second derivative, which grows like e^(4 v t), plus round-off / size.
TEST_P(FreeRigidBodyLimitsTest, DifferenceFromTheLimitIsProportional) {
  using std::abs;
  const FreeRigidBody<Quad> limit = GetParam().Body(Quad(0));
  EXPECT_EQ(limit.polhode(), GetParam().limit);
  for (const double time : {0.5, -1.0, 2.5}) {
    Quad previous = 0;
    for (const double size : {1e-8, 1e-13, 1e-18}) {
      const FreeRigidBody<Quad> body = GetParam().Body(Quad(size));
      EXPECT_EQ(body.polhode(), GetParam().nearby) << size;
      const Quad slope =
          Distance(body.At(Quad(time)), limit.At(Quad(time)), Quad(1)) /
          Quad(size);
      EXPECT_LT(slope, std::exp(4 * std::abs(time)));
      if (previous > 0) {
        EXPECT_NEAR(static_cast<double>(slope / previous), 1.0, 1e-4)
            << "t = " << time << ", size = " << size;
      }
      previous = slope;
    }
    EXPECT_GT(previous, 1e-6) << "t = " << time;
  }
}

INSTANTIATE_TEST_SUITE_P(Approaches, FreeRigidBodyLimitsTest,
                         ::testing::Values(Approach{"SeparatrixFromInside",
                                                    Polhode::kSeparatrix,
                                                    Polhode::kAroundSmallest,
                                                    {3, 4, 6},
                                                    {0, 0, 0},
                                                    {2, -1, 1},
                                                    {1, 0, 0}},
                                           Approach{"SeparatrixFromOutside",
                                                    Polhode::kSeparatrix,
                                                    Polhode::kAroundLargest,
                                                    {3, 4, 6},
                                                    {0, 0, 0},
                                                    {2, -1, 1},
                                                    {0, 0, 1}},
                                           Approach{"MiddleAxisFromInside",
                                                    Polhode::kPoint,
                                                    Polhode::kAroundSmallest,
                                                    {3, 4, 6},
                                                    {0, 0, 0},
                                                    {0, 1, 0},
                                                    {1, 0, 0.1}},
                                           Approach{"MiddleAxisFromOutside",
                                                    Polhode::kPoint,
                                                    Polhode::kAroundLargest,
                                                    {3, 4, 6},
                                                    {0, 0, 0},
                                                    {0, 1, 0},
                                                    {0.1, 0, 1}},
                                           Approach{"SmallestAxis",
                                                    Polhode::kPoint,
                                                    Polhode::kAroundSmallest,
                                                    {2, 3, 4},
                                                    {0, 0, 0},
                                                    {1, 0, 0},
                                                    {0, 1, -0.5}},
                                           Approach{"LargestAxis",
                                                    Polhode::kPoint,
                                                    Polhode::kAroundLargest,
                                                    {2, 3, 4},
                                                    {0, 0, 0},
                                                    {0, 0, 1},
                                                    {0.5, 1, 0}},
                                           Approach{"OblateTop",
                                                    Polhode::kAroundLargest,
                                                    Polhode::kAroundLargest,
                                                    {1, 1, 1.5},
                                                    {0, 1, 0},
                                                    {0.3, -0.5, 1},
                                                    {0, 0, 0}},
                                           Approach{"ProlateTop",
                                                    Polhode::kAroundSmallest,
                                                    Polhode::kAroundSmallest,
                                                    {0.5, 1, 1},
                                                    {0, 0, 1},
                                                    {1, 0.5, 0.75},
                                                    {0, 0, 0}},
                                           Approach{"EquatorOfTop",
                                                    Polhode::kPoint,
                                                    Polhode::kAroundSmallest,
                                                    {1, 1, 1.5},
                                                    {0, 1, 0},
                                                    {0.6, 0.8, 0},
                                                    {0, 0, 0}},
                                           Approach{"Sphere",
                                                    Polhode::kPoint,
                                                    Polhode::kAroundSmallest,
                                                    {2, 2, 2},
                                                    {0, 1, 2},
                                                    {1, 0.4, 0.3},
                                                    {0, 0, 0}}),
                         [](const auto& approach) {
                           return approach.param.name;
                         });

// On the separatrix n_b = tanh: the body turns over once in its whole life.
TEST(FreeRigidBodySeparatrixTest, TendsToTheMiddleAxisAtBothEnds) {
  FreeRigidBodyStart<Quad> start;
  start.inertia = Vector3<Quad>(3, 4, 6).asDiagonal();
  start.angular_velocity = Vector3<Quad>(2, -1, 1);
  const auto body = FreeRigidBody<Quad>::Create(start).value();
  const Quad momentum = sqrt(Quad(36 + 16 + 36));
  for (const double time : {-1e3, 1e3, 1e6}) {
    const Vector3<Quad> omega = body.At(Quad(time)).body_angular_velocity;
    EXPECT_LE(abs(Quad(abs(omega(1)) - momentum / 4)),
              8 * UnitRoundoff<Quad>() * momentum);
    EXPECT_LE(abs(omega(0)), UnitRoundoff<Quad>());
  }
  EXPECT_EQ(body.FlipTimes(Quad(-1e6), Quad(1e6)).size(), 1u);
}

// A double cannot hold how near to the middle axis this start is, squared, but
// it flips, at intervals of 2 K / λ ≈ (2 / λ) ln(4 / δ).
TEST(FreeRigidBodyFlipTest, TinyDisturbanceFlipsAfterItsLogarithm) {
  using std::abs;
  using std::log;
  FreeRigidBodyStart<double> start;
  start.inertia = Vector3<double>(3, 4, 6).asDiagonal();
  start.angular_velocity = Vector3<double>(1e-200, 1, 0);
  const auto body = MakeBody<Quad>(start);
  // Δc = n_b² (J_c−J_b)/J_b → λ² = ω₂² (J₂−J₁)(J₃−J₂)/(J₁ J₃) = 1/9, and
  // m1 = |J_a−J_c| |D| / …, D = n_a² (J₂−J₁)/J₁, n_a = ¾ 1e-200.
  const Quad rate = Quad(1) / 3;
  const Quad m1 = Quad(3) * 9 / 16 * 1e-200 * 1e-200 / 3 / (Quad(1) / 2);
  EXPECT_NEAR(static_cast<double>(body.parameter().m1 / m1), 1.0, 1e-14);
  const Quad period = *body.Period();
  EXPECT_LE(abs(Quad(period - 2 * log(Quad(16 / m1)) / rate)), 1e-30 * period);
  const std::vector<Quad> flips = body.FlipTimes(Quad(0), period);
  ASSERT_EQ(flips.size(), 2u);
  EXPECT_LT(body.At(flips[0] - 1).body_angular_velocity(1) *
                body.At(flips[0] + 1).body_angular_velocity(1),
            Quad(-0.01));
}

}  // namespace
}  // namespace emmy::exact
