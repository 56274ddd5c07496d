// The closed form against an integration of the equations that shares nothing
// with it, to about 1e-31.

#include <gtest/gtest.h>

#include <string_view>

#include "tests/exact/regimes.h"
#include "tests/exact/sensitivity.h"
#include "tests/exact/taylor_integrator.h"

namespace emmy::exact {
namespace {

std::vector<Regime> IntegratedRegimes() {
  std::vector<Regime> chosen;
  for (const Regime& regime : Regimes()) {
    const std::string_view name = regime.name;
    if (name == "PaperBox" || name == "AroundSmallest" || name == "GazeboBox" ||
        name == "NearMiddleAxis" || name == "OnSeparatrix" ||
        name == "NearlyTop") {
      chosen.push_back(regime);
    }
  }
  return chosen;
}

class FreeRigidBodyIntegrationTest : public ::testing::TestWithParam<Regime> {
 protected:
  // Each step cuts its series, and rounds its result, by about one u.
  static constexpr int kStepErrorUnits = 1;
};

// After 12 radians: error 1e-33 … 6e-33, bound 1e-31 … 6e-31.
TEST_P(FreeRigidBodyIntegrationTest, AgreesWithATaylorSeriesIntegration) {
  FreeRigidBodyStart<Quad> start = GetParam().Start().Cast<Quad>();
  start.attitude = NearestRotation(start.attitude);
  const Quad speed = GetParam().Speed();
  const auto body = FreeRigidBody<Quad>::Create(start).value();
  TaylorIntegrator integrator(start, speed);
  constexpr int kLeg = 3 * TaylorIntegrator::kStepsPerRadian;
  for (int leg = 1; leg <= 4; ++leg) {
    integrator.Advance(kLeg);
    const Quad time = integrator.time();
    const Quad error = Distance(integrator.state(), body.At(time), speed);
    const Quad size = kStepErrorUnits * leg * kLeg * UnitRoundoff<Quad>();
    const Quad bound = Sensitivity(start, time, speed, size);
    EXPECT_LE(error, bound) << "after " << 3 * leg << " radians";
    if (leg == 4) RecordProperty("error", error.str(3));
    if (leg == 4) RecordProperty("bound", bound.str(3));
  }
}

// The comparison sees a body whose largest moment is off by 1e-27 of itself.
TEST(FreeRigidBodyIntegrationCheckTest, RejectsAWrongMoment) {
  const Regime regime = Regimes().front();
  FreeRigidBodyStart<Quad> start = regime.Start().Cast<Quad>();
  start.attitude = NearestRotation(start.attitude);
  const Quad speed = regime.Speed();
  TaylorIntegrator integrator(start, speed);
  const int steps = 3 * TaylorIntegrator::kStepsPerRadian;
  integrator.Advance(steps);
  const Quad size = steps * UnitRoundoff<Quad>();
  const Quad bound = Sensitivity(start, integrator.time(), speed, size);
  start.inertia(2, 2) *= 1 + Quad(1e-27);
  const auto wrong = FreeRigidBody<Quad>::Create(start).value();
  EXPECT_GT(Distance(integrator.state(), wrong.At(integrator.time()), speed),
            100 * bound);
}

INSTANTIATE_TEST_SUITE_P(Regimes, FreeRigidBodyIntegrationTest,
                         ::testing::ValuesIn(IntegratedRegimes()), RegimeName);

}  // namespace
}  // namespace emmy::exact
