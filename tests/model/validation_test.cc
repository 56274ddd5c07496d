#include "emmy/model/validation.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

#include "tests/support/random_source.h"

namespace emmy {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(ValidationTest, PositiveAcceptsTheSmallestAndTheLargestNumber) {
  EXPECT_TRUE(
      CheckPositive("/x", std::numeric_limits<double>::denorm_min(), "m").ok());
  EXPECT_TRUE(
      CheckPositive("/x", std::numeric_limits<double>::max(), "m").ok());
}

TEST(ValidationTest, PositiveRejectsZeroAndWhatIsNotFinite) {
  for (const double value : {0.0, -0.0, -1.0, kNan, kInfinity, -kInfinity}) {
    EXPECT_FALSE(CheckPositive("/x", value, "m").ok()) << value;
  }
}

TEST(ValidationTest, NotNegativeAcceptsZero) {
  EXPECT_TRUE(CheckNotNegative("/x", 0.0, "kg").ok());
  EXPECT_EQ(CheckNotNegative("/x", -1.0, "kg").message(),
            "/x: must be a finite number >= 0 [kg], got -1");
  EXPECT_FALSE(CheckNotNegative("/x", kNan, "kg").ok());
  EXPECT_FALSE(CheckNotNegative("/x", kInfinity, "kg").ok());
}

TEST(ValidationTest, FiniteNamesTheEntryAtFault) {
  EXPECT_EQ(CheckFinite("/v", {1.0, kNan, kNan}, "m/s").message(),
            "/v/1: must be a finite number [m/s], got nan");
  EXPECT_TRUE(CheckFinite("/v", {1.0, -2.0, 0.0}, "m/s").ok());
}

TEST(ValidationTest, WithoutUnitThereAreNoBrackets) {
  EXPECT_EQ(CheckPositive("/n", -1.0, "").message(),
            "/n: must be a finite number > 0, got -1");
}

TEST(ValidationTest, NumberTextReadsBackAsTheSameNumber) {
  RandomSource random(20250402);
  for (int trial = 0; trial < 1000; ++trial) {
    const double value = random.Magnitude(1e-300, 1e300);
    EXPECT_EQ(std::strtod(NumberText(value).c_str(), nullptr), value);
  }
  EXPECT_EQ(NumberText(0.1), "0.1");
}

}  // namespace
}  // namespace emmy
