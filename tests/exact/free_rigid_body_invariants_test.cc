// Energy, angular momentum and orthonormality of the closed form, in both
// real types, from the first instant to 10⁴ periods.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/exact/regimes.h"

namespace emmy::exact {
namespace {

class FreeRigidBodyInvariantsTest : public ::testing::TestWithParam<Regime> {
 protected:
  template <typename T>
  std::vector<T> Times(const FreeRigidBody<T>& body) const {
    const T speed{GetParam().Speed()};
    const T period = body.Period().value_or(7 / speed);
    std::vector<T> times;
    for (const double i : {0.0, 1e-3, 0.2, -0.7, 1.0, 13.3, 1e4, -1e4}) {
      times.push_back(i * period);
    }
    return times;
  }

  // Each quantity is a sum of at most nine products of rounded factors.
  template <typename T>
  void Check() const {
    using std::abs;
    using std::sqrt;
    const FreeRigidBodyStart<T> start = GetParam().Start().template Cast<T>();
    const auto body = MakeBody<T>(GetParam().Start());
    const FreeRigidBodyState<T> first = body.At(T{0});
    const T size = sqrt(first.angular_momentum.squaredNorm());
    const Vector3<T> omega = start.angular_velocity;
    const T energy = omega.dot(start.inertia * omega);
    const T u = UnitRoundoff<T>();
    for (const T& time : Times(body)) {
      const FreeRigidBodyState<T> state = body.At(time);
      const Vector3<T>& w = state.body_angular_velocity;
      const Vector3<T> momentum = start.inertia * w;
      const T kinetic = w.dot(momentum);
      EXPECT_LE(abs(kinetic - energy), 40 * u * energy) << time;
      const Vector3<T> carried = state.attitude * momentum;
      EXPECT_LE((carried - first.angular_momentum).cwiseAbs().maxCoeff(),
                24 * u * size)
          << time;
      EXPECT_LE((state.angular_momentum - first.angular_momentum)
                    .cwiseAbs()
                    .maxCoeff(),
                24 * u * size)
          << time;
      const Matrix3<T> square = state.attitude.transpose() * state.attitude;
      EXPECT_LE((square - Matrix3<T>::Identity()).cwiseAbs().maxCoeff(), 24 * u)
          << time;
      EXPECT_GT(state.attitude.col(0)
                    .cross(state.attitude.col(1))
                    .dot(state.attitude.col(2)),
                T{0});
    }
  }
};

TEST_P(FreeRigidBodyInvariantsTest, HoldInDouble) { Check<double>(); }

TEST_P(FreeRigidBodyInvariantsTest, HoldInQuad) { Check<Quad>(); }

TEST_P(FreeRigidBodyInvariantsTest, HasAPeriodUnlessConstantOrOnSeparatrix) {
  using std::abs;
  const auto body = MakeBody<Quad>(GetParam().Start());
  const bool repeats = body.polhode() == Polhode::kAroundSmallest ||
                       body.polhode() == Polhode::kAroundLargest;
  ASSERT_EQ(body.Period().has_value(), repeats);
  if (!repeats) return;
  const Quad speed = GetParam().Speed();
  const Quad period = *body.Period();
  const Quad time = 1 / speed;
  const Vector3<Quad> change = body.At(time).body_angular_velocity -
                               body.At(time + period).body_angular_velocity;
  EXPECT_LE(change.cwiseAbs().maxCoeff(),
            64 * UnitRoundoff<Quad>() * speed * (1 + speed * period));
}

TEST_P(FreeRigidBodyInvariantsTest, MotionStartsFromTheGivenState) {
  const FreeRigidBodyStart<double> start = GetParam().Start();
  const auto state = MakeBody<double>(start).At(0.0);
  const double u = UnitRoundoff<double>();
  EXPECT_LE((state.attitude - start.attitude).cwiseAbs().maxCoeff(), 16 * u);
  EXPECT_LE((state.body_angular_velocity - start.angular_velocity)
                .cwiseAbs()
                .maxCoeff(),
            16 * u * GetParam().Speed());
}

// A state on the way is a start of the same motion, also backwards in time.
TEST_P(FreeRigidBodyInvariantsTest, MotionContinuesFromAnyOfItsStates) {
  const FreeRigidBodyStart<Quad> start = GetParam().Start().Cast<Quad>();
  const auto body = MakeBody<Quad>(GetParam().Start());
  const Quad speed = GetParam().Speed();
  const Quad on_the_way = 2 / speed;
  const FreeRigidBodyState<Quad> state = body.At(on_the_way);
  FreeRigidBodyStart<Quad> next = start;
  next.attitude = state.attitude;
  next.angular_velocity = state.angular_velocity;
  next.angular_velocity_frame = Frame::kInertial;
  const auto again = FreeRigidBody<Quad>::Create(next).value();
  for (const double turn : {-5.0, -2.0, 3.0}) {
    const Quad time = turn / speed;
    // Neighbouring motions part by no more than e^(3 v |t|), as
    // |δl̇| ≤ 2 v |δl| and |δR'| ≤ v |δR| + |δω|.
    using std::exp;
    EXPECT_LE(Distance(again.At(time), body.At(on_the_way + time), speed),
              32 * UnitRoundoff<Quad>() * exp(Quad(3 * std::abs(turn))));
  }
}

INSTANTIATE_TEST_SUITE_P(Regimes, FreeRigidBodyInvariantsTest,
                         ::testing::ValuesIn(Regimes()), RegimeName);

}  // namespace
}  // namespace emmy::exact
