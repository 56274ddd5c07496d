// The evaluation in double agrees with the one in Quad as far as the data,
// themselves rounded, define the motion.

#include <gtest/gtest.h>

#include "tests/exact/regimes.h"
#include "tests/exact/sensitivity.h"

namespace emmy::exact {
namespace {

// The double evaluation is exact for data changed by this many u.
constexpr int kBackwardUnits = 8;

Quad ShareOfBound(const Regime& regime, double time) {
  const FreeRigidBodyStart<double> start = regime.Start();
  const Quad speed = regime.Speed();
  const auto rounded = MakeBody<double>(start).At(time).Cast<Quad>();
  const auto reference = MakeBody<Quad>(start).At(Quad(time));
  const Quad size = kBackwardUnits * Quad(UnitRoundoff<double>());
  return Distance(rounded, reference, speed) /
         Sensitivity(start.Cast<Quad>(), Quad(time), speed, size);
}

class FreeRigidBodyPrecisionTest : public ::testing::TestWithParam<Regime> {};

// Worst shares of the bound: 0.51 (GazeboBox), 0.43 (TiltedTensor).
TEST_P(FreeRigidBodyPrecisionTest, DoubleIsBackwardStable) {
  Quad worst = 0;
  for (const double turn : {0.0, 0.01, 1.0, -2.0, 5.0, 11.0, -23.0, 97.0}) {
    const Quad share = ShareOfBound(GetParam(), turn / GetParam().Speed());
    EXPECT_LE(share, 1) << "after " << turn << " radians";
    worst = std::max(worst, share);
  }
  RecordProperty("worst_share_of_bound", worst.str(3));
}

TEST_P(FreeRigidBodyPrecisionTest, DoubleIsBackwardStableAfter1e5Radians) {
  for (const double turn : {1e5, -1e5}) {
    const Quad share = ShareOfBound(GetParam(), turn / GetParam().Speed());
    EXPECT_LE(share, 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Regimes, FreeRigidBodyPrecisionTest,
                         ::testing::ValuesIn(Regimes()), RegimeName);

// What the header promises in plain numbers where the motion is stable;
// measured 2.5 u (1 + v t).
TEST(FreeRigidBodyAccuracyTest, PaperBoxInDoubleErrsByAFewRoundoffs) {
  const Regime regime = Regimes().front();
  const auto rounded = MakeBody<double>(regime.Start());
  const auto reference = MakeBody<Quad>(regime.Start());
  const Quad speed = regime.Speed();
  for (int i = -50; i <= 50; ++i) {
    const double time = 0.37 * i;
    const Quad radians = 1 + speed * std::abs(time);
    EXPECT_LE(Distance(rounded.At(time).Cast<Quad>(), reference.At(Quad(time)),
                       speed),
              4 * UnitRoundoff<double>() * radians)
        << "t = " << time;
  }
}

}  // namespace
}  // namespace emmy::exact
