// The closed form satisfies (TOP-3), J ω̇ + ω × J ω = 0 and Ṙ = R ω̂, in every
// regime; and the check that says so rejects motions that are slightly wrong.

#include <gtest/gtest.h>

#include "tests/exact/equation_residual.h"
#include "tests/exact/regimes.h"

namespace emmy::exact {
namespace {

// Values err by at most this many u (1 + v |t|); see the measured numbers in
// the tests below.
constexpr int kErrorUnits = 4;

class FreeRigidBodyEquationsTest : public ::testing::TestWithParam<Regime> {};

// Worst: 0.26 of the bound.
TEST_P(FreeRigidBodyEquationsTest, ResidualIsRoundoff) {
  const FreeRigidBodyStart<double> start = GetParam().Start();
  const auto body = MakeBody<Quad>(start);
  EXPECT_EQ(body.polhode(), GetParam().polhode);
  const Quad speed = GetParam().Speed();
  const EquationResidual residual(start.inertia.cast<Quad>(), speed);
  const QuadMotion motion = [&body](const Quad& t) { return body.At(t); };
  Quad worst = 0;
  for (const double turn : {0.0, 0.1, -1.0, 3.0, 17.0, -60.0, 300.0}) {
    const Quad time = turn / speed;
    const Quad r = residual(motion, time);
    const Quad bound = residual.Bound(time, kErrorUnits);
    EXPECT_LE(r, bound) << "at " << turn << " radians";
    worst = std::max(worst, Quad(r / bound));
  }
  RecordProperty("worst_share_of_bound", worst.str(3));
}

INSTANTIATE_TEST_SUITE_P(Regimes, FreeRigidBodyEquationsTest,
                         ::testing::ValuesIn(Regimes()), RegimeName);

// Each mutant is the true motion with one thing wrong. The residual must be
// at least as large as the error that was put in, far above the bound.
class EquationCheckTest : public ::testing::Test {
 protected:
  EquationCheckTest()
      : regime_(Regimes().front()),
        body_(MakeBody<Quad>(regime_.Start())),
        residual_(regime_.Start().inertia.cast<Quad>(), Quad(regime_.Speed())) {
    const Vector3<Quad> momentum = body_.At(Quad(0)).angular_momentum;
    axis_ = momentum / sqrt(momentum.squaredNorm());
  }

  // Extra precession about L by rate [v] · t.
  FreeRigidBodyState<Quad> Precessing(const Quad& rate, const Quad& t) const {
    FreeRigidBodyState<Quad> state = body_.At(t);
    const Vector3<Quad> angle = axis_ * (rate * Quad(regime_.Speed()) * t);
    state.attitude = (RotationFromVector(angle) * state.attitude).eval();
    return state;
  }

  Quad Residual(const QuadMotion& motion) const {
    return residual_(motion, Quad(7));
  }
  Quad Bound() const { return residual_.Bound(Quad(7), kErrorUnits); }

  Regime regime_;
  FreeRigidBody<Quad> body_;
  EquationResidual residual_;
  Vector3<Quad> axis_;
};

TEST_F(EquationCheckTest, AcceptsTheSolution) {
  EXPECT_LE(Residual([this](const Quad& t) { return body_.At(t); }), Bound());
}

TEST_F(EquationCheckTest, RejectsPrecessionOfTheWrongSign) {
  // L / J_c is the largest part of ψ̇; taken twice away it has changed sign.
  const Quad r =
      Residual([this](const Quad& t) { return Precessing(Quad(-2), t); });
  EXPECT_GT(r, 0.1);
}

TEST_F(EquationCheckTest, RejectsPrecessionOffByOnePartIn1e24) {
  const Quad r =
      Residual([this](const Quad& t) { return Precessing(Quad(1e-24), t); });
  EXPECT_GT(r, 1e-25);
  EXPECT_GT(r, 1000 * Bound());
}

TEST_F(EquationCheckTest, RejectsOneComponentOfTheWrongSign) {
  const Quad r = Residual([this](const Quad& t) {
    FreeRigidBodyState<Quad> state = body_.At(t);
    state.body_angular_velocity(1) = -state.body_angular_velocity(1);
    return state;
  });
  EXPECT_GT(r, 0.01);
}

TEST_F(EquationCheckTest, RejectsInertiaOffByOnePartIn1e24) {
  FreeRigidBodyStart<Quad> start = regime_.Start().Cast<Quad>();
  start.inertia(0, 0) *= 1 + Quad(1e-24);
  const auto other = FreeRigidBody<Quad>::Create(start).value();
  const Quad r = Residual([&other](const Quad& t) { return other.At(t); });
  EXPECT_GT(r, 1e-26);
  EXPECT_GT(r, 100 * Bound());
}

TEST_F(EquationCheckTest, RejectsAttitudeAtAShiftedTime) {
  const Quad r = Residual([this](const Quad& t) {
    FreeRigidBodyState<Quad> state = body_.At(t);
    state.attitude = body_.At(t + Quad(1e-24)).attitude;
    return state;
  });
  EXPECT_GT(r, 1e-26);
}

}  // namespace
}  // namespace emmy::exact
