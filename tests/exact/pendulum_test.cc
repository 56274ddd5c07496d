#include "verification/exact/pendulum.h"

#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <cmath>

namespace emmy::exact {
namespace {

const Quad kPi = boost::math::constants::pi<Quad>();
const Quad kGravity = Quad("9.81");

Quad Abs(const Quad& x) { return x < 0 ? -x : x; }

// IFToMM benchmark A01: 1 m, released at x = −1, y = 0. The published period,
// and rows of its solution to 15 digits, half a unit in the last.
TEST(PendulumTest, PeriodFromTheHorizontalAgreesWithEveryDigit) {
  const Pendulum<Quad> pendulum(Quad(1), kGravity, Quad(-kPi / 2));
  EXPECT_LE(
      Abs(Quad(pendulum.Period() - Quad("2.36784194757623744930329503723863"))),
      5e-33);
}

TEST(PendulumTest, BenchmarkRowsAgreeWithEveryDigit) {
  const Pendulum<Quad> pendulum(Quad(1), kGravity, Quad(-kPi / 2));
  struct Row {
    int time;
    const char* x;
    const char* y;
  };
  for (const Row& row :
       {Row{0, "-1", "0"}, Row{10, "-0.275087462576117", "-0.961419205099125"},
        Row{100, "-0.181513351427031", "-0.983388480334058"},
        Row{2000, "0.814603068589032", "-0.580018827836935"}}) {
    const auto state = pendulum.At(Quad(row.time));
    EXPECT_LE(Abs(Quad(state.x - Quad(row.x))), 5.1e-16) << row.time;
    EXPECT_LE(Abs(Quad(state.y - Quad(row.y))), 5.1e-16) << row.time;
  }
}

class PendulumAngleTest : public ::testing::TestWithParam<double> {
 protected:
  Quad Release() const { return kPi * GetParam(); }
  Pendulum<Quad> Make() const {
    return Pendulum<Quad>(Quad(2), kGravity, Release());
  }
};

TEST_P(PendulumAngleTest, EnergyIsThatOfTheRelease) {
  using std::cos;
  using std::sin;
  const Pendulum<Quad> pendulum = Make();
  const Quad size = Release() * Release() * kGravity;
  for (const double time : {0.0, 0.4, -1.1, 3.0, 1e3}) {
    const auto state = pendulum.At(Quad(time));
    // g (cos θ − cos θ₀) as a product, which does not cancel.
    const Quad fall = 2 * kGravity * sin(Quad((Release() + state.angle) / 2)) *
                      sin(Quad((Release() - state.angle) / 2));
    const Quad kinetic = state.angular_velocity * state.angular_velocity;
    EXPECT_LE(Abs(Quad(kinetic - fall)), 1e-32 * size) << time;
  }
}

// Fourth-order difference of θ̇ against the equation of motion: the error is
// h⁴ / 30 · |d⁵θ/dt⁵|, here below 1e-24, and rounding below 1e-33 / h.
TEST_P(PendulumAngleTest, SatisfiesTheEquationOfMotion) {
  using std::sin;
  const Pendulum<Quad> pendulum = Make();
  const Quad h = 1e-7;
  for (const double time : {0.0, 0.7, -1.3, 5.1}) {
    const auto omega = [&](int i) {
      return pendulum.At(time + i * h).angular_velocity;
    };
    const auto angle = [&](int i) { return pendulum.At(time + i * h).angle; };
    const Quad acceleration =
        (8 * (omega(1) - omega(-1)) - (omega(2) - omega(-2))) / (12 * h);
    const Quad rate =
        (8 * (angle(1) - angle(-1)) - (angle(2) - angle(-2))) / (12 * h);
    EXPECT_LE(Abs(Quad(rate - omega(0))), 1e-23) << time;
    EXPECT_LE(Abs(Quad(acceleration + kGravity / 2 * sin(angle(0)))), 1e-23)
        << time;
  }
}

TEST_P(PendulumAngleTest, DoubleErrsByAFewRoundoffs) {
  const Pendulum<Quad> reference(Quad(2.0), Quad(9.81), Quad(GetParam()));
  const Pendulum<double> rounded(2.0, 9.81, GetParam());
  for (const double time : {0.0, 0.4, -1.1, 3.0, 100.0}) {
    const Quad angle = reference.At(Quad(time)).angle;
    const Quad bound = 0x1p-53 * Quad(8 * (1 + 2.3 * std::abs(time)));
    EXPECT_LE(Abs(Quad(rounded.At(time).angle - angle)), bound) << time;
  }
}

// In half turns, from the linear range to almost upright.
INSTANTIATE_TEST_SUITE_P(ReleaseAngles, PendulumAngleTest,
                         ::testing::Values(1e-9, 0.01, 0.5, -0.5, 0.75, 0.999));

TEST(PendulumTest, SmallSwingsHaveTheLinearPeriod) {
  using std::sqrt;
  const Pendulum<Quad> pendulum(Quad(1), kGravity, Quad(1e-8));
  const Quad linear = 2 * kPi / sqrt(kGravity);
  // T = 2π √(l/g) (1 + θ₀²/16 + …)
  EXPECT_NEAR(
      static_cast<double>((pendulum.Period() / linear - 1) * 16 / Quad(1e-16)),
      1.0, 1e-14);
}

TEST(PendulumDeathTest, UprightReleaseIsRefused) {
  EXPECT_DEATH(Pendulum<double>(1.0, 9.81, 3.2), "release_angle");
}

}  // namespace
}  // namespace emmy::exact
