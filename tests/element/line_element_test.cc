#include "emmy/element/line_element.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "tests/support/random_source.h"
#include "tests/support/roundoff_bound.h"
#include "tests/support/wide.h"

namespace emmy {
namespace {

constexpr double kLength = 1.3;       // [m]
constexpr double kStiffness = 7.0e3;  // EA [N], k [N/m]

struct Regime {
  const char* name;
  LineElement element;
  double start;  // Length at the start of a step, over the natural length.
  double step;   // |Δd| over the natural length.
  friend void PrintTo(const Regime& r, std::ostream* os) { *os << r.name; }
};

// A step from d₀ to d₁.
struct Step {
  Vector3d d0;
  Vector3d d1;
  double Ds() const { return (0.5 * (d0 + d1)).dot(d1 - d0); }
};

Step RandomStep(const Regime& regime, RandomSource* random) {
  const double length = regime.element.natural_length() > 0.0
                            ? regime.element.natural_length()
                            : kLength;
  const Vector3d d0 = regime.start * length * random->Direction<Vector3d>();
  return {d0, d0 + regime.step * length * random->Direction<Vector3d>()};
}

WideVector3 Widen(const Vector3d& v) { return v.cast<Wide>(); }

// W as a function of the ends alone, in 100 digits.
Wide WideEnergy(const LineElement& element, const Vector3d& d) {
  const Wide length = element.natural_length();
  const Wide square = Widen(d).squaredNorm();
  const Wide stiffness = element.stiffness();
  if (element.kind() == LineElement::Kind::kSpring) {
    const Wide extension = sqrt(square) - length;
    return stiffness * extension * extension / 2;
  }
  const Wide strain = (square - length * length) / (2 * length * length);
  if (element.kind() == LineElement::Kind::kCable && strain < 0) return 0;
  return stiffness * length * strain * strain / 2;
}

DoubleDouble StartValue(const LineElement& element, const Vector3d& d) {
  return element.Value(DoubleDouble3::FromDouble(d));
}

// Scale of the terms of W: a value is built from terms of size (l/L)² or l,
// and stiffness carries its error into the energy.
double EnergyMagnitude(const LineElement& element, const Step& step) {
  const double length = element.natural_length();
  const double longest = std::max(step.d0.norm(), step.d1.norm());
  if (element.kind() == LineElement::Kind::kSpring) {
    return element.stiffness() * std::pow(longest + length, 2);
  }
  const double ratio = longest * longest / (length * length);
  return element.stiffness() * length * std::pow(ratio + 1.0, 2);
}

class LineElementStepTest : public ::testing::TestWithParam<Regime> {};

TEST_P(LineElementStepTest, DoesTheWorkOfTheEnergyDifference) {
  const LineElement& element = GetParam().element;
  RandomSource random(20250114);
  for (int trial = 0; trial < 300; ++trial) {
    const Step step = RandomStep(GetParam(), &random);
    const DoubleDouble value = StartValue(element, step.d0);
    const LineElement::Response response =
        element.Respond(value.hi, value.lo, step.Ds());
    const Wide work =
        Wide(response.tension_factor) *
        (Widen(step.d0) + Widen(step.d1)).dot(Widen(step.d1) - Widen(step.d0)) /
        2;
    const Wide gain =
        WideEnergy(element, step.d1) - WideEnergy(element, step.d0);
    EXPECT_LE(ToDouble(abs(Wide(work - gain))),
              RoundoffBound(16, EnergyMagnitude(element, step)))
        << "trial " << trial;
  }
}

TEST_P(LineElementStepTest, AdvancesItsValueToThatOfTheEnds) {
  const LineElement& element = GetParam().element;
  RandomSource random(20250115);
  for (int trial = 0; trial < 300; ++trial) {
    const Step step = RandomStep(GetParam(), &random);
    const DoubleDouble before = StartValue(element, step.d0);
    const double increment =
        element.Respond(before.hi, before.lo, step.Ds()).increment;
    const double gain = (StartValue(element, step.d1) - before).ToDouble();
    const double length = element.natural_length();
    const double longest = std::max(step.d0.norm(), step.d1.norm());
    const double scale =
        element.kind() == LineElement::Kind::kSpring
            ? longest * longest / (step.d0.norm() + step.d1.norm())
            : longest * longest / (length * length);
    EXPECT_NEAR(increment, gain, RoundoffBound(12, scale)) << "trial " << trial;
  }
}

TEST_P(LineElementStepTest, DerivativeIsThatOfTheTensionFactor) {
  const LineElement& element = GetParam().element;
  RandomSource random(20250116);
  for (int trial = 0; trial < 100; ++trial) {
    const Step step = RandomStep(GetParam(), &random);
    const double ds = step.Ds();
    const DoubleDouble value = StartValue(element, step.d0);
    const double h = 1e-5 * step.d1.squaredNorm();
    const auto tension = [&](double at) {
      return element.Respond(value.hi, value.lo, at).tension_factor;
    };
    const double difference = (tension(ds + h) - tension(ds - h)) / (2.0 * h);
    const double derivative =
        element.Respond(value.hi, value.lo, ds).derivative;
    // A cable's derivative jumps where the step ends at zero strain.
    if (element.kind() == LineElement::Kind::kCable &&
        (tension(ds + h) == 0.0) != (tension(ds - h) == 0.0)) {
      continue;
    }
    const double scale =
        element.stiffness() / std::pow(std::min(step.d1.norm(), kLength), 3);
    EXPECT_NEAR(derivative, difference, 1e-4 * scale) << "trial " << trial;
  }
}

const LineElement kTruss = LineElement::Truss(kLength, kStiffness);
const LineElement kCable = LineElement::Cable(kLength, kStiffness);
const LineElement kSpring = LineElement::Spring(kLength, kStiffness);
const LineElement kNoLength = LineElement::Spring(0.0, kStiffness);

INSTANTIATE_TEST_SUITE_P(
    Regimes, LineElementStepTest,
    ::testing::Values(Regime{"TrussNearRest", kTruss, 1.0, 1e-8},
                      Regime{"TrussStretched", kTruss, 1.3, 0.1},
                      Regime{"TrussCompressed", kTruss, 0.4, 0.1},
                      Regime{"TrussLongStep", kTruss, 1.0, 5.0},
                      Regime{"CableTaut", kCable, 1.5, 0.1},
                      Regime{"CableSlack", kCable, 0.5, 0.1},
                      Regime{"CableOnTheEdge", kCable, 1.0, 0.1},
                      Regime{"CableAcrossToSlack", kCable, 1.05, 0.8},
                      Regime{"CableAcrossToTaut", kCable, 0.95, 0.8},
                      Regime{"CableLongStep", kCable, 0.5, 5.0},
                      Regime{"SpringNearRest", kSpring, 1.0, 1e-8},
                      Regime{"SpringStretched", kSpring, 1.3, 0.1},
                      Regime{"SpringCompressed", kSpring, 0.4, 0.1},
                      Regime{"SpringLongStep", kSpring, 1.0, 5.0},
                      Regime{"SpringWithoutLength", kNoLength, 1.0, 0.1},
                      Regime{"SpringWithoutLengthLongStep", kNoLength, 1.0,
                             5.0}),
    [](const auto& regime) { return regime.param.name; });

// What the identity is worth: with the tension at the middle of the step it
// fails by orders of magnitude wherever steps are not tiny.
TEST(LineElementTest, TensionOfTheMiddleWouldNotDoTheWork) {
  RandomSource random(20250117);
  double worst = 0.0;
  for (int trial = 0; trial < 100; ++trial) {
    const Step step = RandomStep({"", kTruss, 1.3, 0.5}, &random);
    const Vector3d middle = 0.5 * (step.d0 + step.d1);
    const double tension =
        kStiffness / kLength * StartValue(kTruss, middle).ToDouble();
    const double gain =
        ToDouble(WideEnergy(kTruss, step.d1) - WideEnergy(kTruss, step.d0));
    worst = std::max(worst, std::abs(tension * step.Ds() - gain) /
                                EnergyMagnitude(kTruss, step));
  }
  EXPECT_GT(worst, 1e9 * RoundoffBound(16, 1.0));
}

TEST(LineElementTest, CableWithoutTensionHasNeitherForceNorEnergy) {
  EXPECT_EQ(kCable.Tension(-0.1), 0.0);
  EXPECT_EQ(kCable.Energy(DoubleDouble(-0.1)).ToDouble(), 0.0);
  EXPECT_GT(kCable.Tension(0.1), 0.0);
}

TEST(LineElementTest, TensionIsTheForceAlongTheLine) {
  // Green–Lagrange strain 0.22 at l = 1.2 L.
  EXPECT_NEAR(kTruss.Tension(0.22), kStiffness * 0.22 * 1.2, 1e-9);
  EXPECT_NEAR(kSpring.Tension(0.2), kStiffness * 0.2, 1e-9);
}

TEST(LineElementTest, SpringStrainIsRelativeWhereItHasALength) {
  EXPECT_DOUBLE_EQ(kSpring.Strain(0.26), 0.2);
  EXPECT_DOUBLE_EQ(kNoLength.Strain(0.26), 0.26);
}

}  // namespace
}  // namespace emmy
