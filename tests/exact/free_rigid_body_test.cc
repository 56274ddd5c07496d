// What Create accepts and refuses, and the small questions.

#include "verification/exact/free_rigid_body.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <string_view>

#include "tests/exact/regimes.h"

namespace emmy::exact {
namespace {

using ::testing::HasSubstr;

std::string ErrorOf(const FreeRigidBodyStart<double>& start) {
  const auto body = FreeRigidBody<double>::Create(start);
  if (body.ok()) return "accepted";
  EXPECT_EQ(body.status().code(), absl::StatusCode::kInvalidArgument);
  return std::string(body.status().message());
}

TEST(FreeRigidBodyCreateTest, RejectsMomentsNoBodyHas) {
  FreeRigidBodyStart<double> start;
  start.inertia = Vector3<double>(1, 2, 3).asDiagonal();
  EXPECT_THAT(ErrorOf(start), HasSubstr("J1 + J2 > J3"));
  start.inertia = Vector3<double>(-1, 2, 2).asDiagonal();
  EXPECT_THAT(ErrorOf(start), HasSubstr("got -1, 2, 2"));
}

TEST(FreeRigidBodyCreateTest, RejectsAnInertiaThatIsNotSymmetric) {
  FreeRigidBodyStart<double> start;
  start.inertia(0, 1) = 0.1;
  EXPECT_THAT(ErrorOf(start), HasSubstr("inertia must be symmetric"));
}

TEST(FreeRigidBodyCreateTest, RejectsAReflectionAsAttitude) {
  FreeRigidBodyStart<double> start;
  start.attitude(2, 2) = -1;
  EXPECT_THAT(ErrorOf(start), HasSubstr("attitude must be a rotation"));
}

TEST(FreeRigidBodyCreateTest, RejectsWhatIsNotFinite) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  FreeRigidBodyStart<double> start;
  start.attitude(1, 0) = kNaN;
  EXPECT_THAT(ErrorOf(start), HasSubstr("attitude"));
  start = {};
  start.inertia(1, 1) = kNaN;
  EXPECT_THAT(ErrorOf(start), HasSubstr("inertia must be finite"));
  start = {};
  start.angular_velocity(2) = std::numeric_limits<double>::infinity();
  EXPECT_THAT(ErrorOf(start), HasSubstr("angular_velocity must be finite"));
}

TEST(FreeRigidBodyCreateTest, TakesInertialAngularVelocity) {
  FreeRigidBodyStart<double> start = Regimes().front().Start();
  const auto body = MakeBody<double>(start);
  start.angular_velocity = (start.attitude * start.angular_velocity).eval();
  start.angular_velocity_frame = Frame::kInertial;
  const auto same = MakeBody<double>(start);
  EXPECT_LE(Distance(body.At(1.0), same.At(1.0), 1.0), 1e-15);
}

// Scaling mass, length and time scales the answer; powers of two exactly.
TEST(FreeRigidBodyTest, ScalesExactlyFromTinyToHuge) {
  const FreeRigidBodyStart<double> start = Regimes().front().Start();
  const auto body = MakeBody<double>(start);
  for (const double mass : {0x1p-300, 0x1p300}) {
    for (const double rate : {0x1p-200, 0x1p200}) {
      FreeRigidBodyStart<double> scaled = start;
      scaled.inertia *= mass;
      scaled.angular_velocity *= rate;
      const auto other = MakeBody<double>(scaled);
      EXPECT_EQ(other.At(3.0 / rate).attitude, body.At(3.0).attitude)
          << mass << ", " << rate;
    }
  }
}

TEST(FreeRigidBodyDeathTest, TimeMustBeFinite) {
  const auto body = MakeBody<double>(Regimes().front().Start());
  EXPECT_DEATH(body.At(std::numeric_limits<double>::infinity()), "isfinite");
}

TEST(FreeRigidBodyTest, FlipTimesAreZerosOfTheMiddleComponentInOrder) {
  for (const Regime& regime : Regimes()) {
    const auto body = MakeBody<Quad>(regime.Start());
    const std::vector<Quad> flips = body.FlipTimes(Quad(-40), Quad(40));
    if (regime.polhode == Polhode::kPoint) {
      EXPECT_TRUE(flips.empty()) << regime.name;
      continue;
    }
    if (regime.tilt(0) != 1) continue;  // No component along a body axis.
    if (std::string_view(regime.name) == "OblateTop") continue;
    Vector3<double> j = regime.moments;
    std::sort(j.data(), j.data() + 3);
    int middle = 0;
    while (regime.moments(middle) != j(1)) ++middle;
    Quad previous = -40;
    for (const Quad& time : flips) {
      EXPECT_GE(time, previous) << regime.name;
      previous = time;
      const Quad omega = body.At(time).body_angular_velocity(middle);
      EXPECT_LE(abs(omega), 1e-29 * regime.Speed()) << regime.name;
    }
  }
}

}  // namespace
}  // namespace emmy::exact
