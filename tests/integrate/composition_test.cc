// What composed steps of order four and six promise beside the laws.

#include "emmy/integrate/composition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "emmy/numerics/rotation.h"
#include "emmy/numerics/unit_roundoff.h"
#include "tests/integrate/allocation_counter.h"
#include "tests/support/roundoff_bound.h"
#include "tests/support/structures.h"
#include "tests/support/test_run.h"

namespace emmy {
namespace {

// A symmetric second-order step is exp(h A₁ + h³ A₃ + h⁵ A₅ + …). A product of
// such steps is a series in words of the letters 1, 3, 5, a word's weight the
// sum of its letters.
using Series = std::map<std::string, long double>;

int Weight(const std::string& word) {
  int weight = 0;
  for (const char letter : word) weight += letter - '0';
  return weight;
}

Series Product(const Series& a, const Series& b, int max_weight) {
  Series product;
  for (const auto& [left, x] : a) {
    for (const auto& [right, y] : b) {
      if (Weight(left) + Weight(right) <= max_weight) {
        product[left + right] += x * y;
      }
    }
  }
  return product;
}

// exp of h A₁ + h³ A₃ + h⁵ A₅.
Series Exponential(long double h, int max_weight) {
  const Series exponent = {
      {"1", h}, {"3", h * h * h}, {"5", h * h * h * h * h}};
  Series sum = {{"", 1.0L}};
  Series term = sum;
  for (int k = 1; k <= max_weight; ++k) {
    term = Product(term, exponent, max_weight);
    for (auto& [word, value] : term) {
      value /= k;
      sum[word] += value;
    }
  }
  return sum;
}

// The coefficient of exp A₁.
long double Exact(const std::string& word) {
  if (word.find_first_not_of('1') != std::string::npos) return 0.0L;
  return 1.0L / std::tgamma(static_cast<long double>(word.size()) + 1);
}

class CompositionTest : public ::testing::TestWithParam<int> {
 protected:
  int order() const { return GetParam(); }
  IntegratorOptions Options(double time_step) const {
    return {.order = order(), .time_step = time_step};
  }

  // Of all parts of Δt = 1.
  Series Composed(int max_weight) const {
    Series series = {{"", 1.0L}};
    for (const double h : SubSteps(order(), 1.0)) {
      series =
          Product(series, Exponential(static_cast<long double>(h), max_weight),
                  max_weight);
    }
    return series;
  }

  // What a coefficient may be off by for the rounding of the parts. It is a sum
  // of products of parts with positive factors: of parts h ± δ it is off by no
  // more than the same sum of |h| + δ less that of |h|. A part is half of a γ
  // below 1 that is rounded twice, to u each, which is δ = u; those in the
  // middle are what is left to 1 by all others. Sums are of 64 bits.
  Series RoundingBounds(int max_weight) const {
    const std::vector<double> parts = SubSteps(order(), 1.0);
    const size_t middle = parts.size() / 2;
    const auto others = static_cast<long double>(parts.size() - 2);
    Series upper = {{"", 1.0L}};
    Series lower = upper;
    for (size_t i = 0; i < parts.size(); ++i) {
      const bool is_outer = i + 1 < middle || i > middle;
      const long double h = std::abs(static_cast<long double>(parts[i]));
      const long double off = static_cast<long double>(kUnitRoundoff) *
                              (is_outer ? 1.0L : 0.5L * others);
      upper = Product(upper, Exponential(h + off, max_weight), max_weight);
      lower = Product(lower, Exponential(h, max_weight), max_weight);
    }
    for (auto& [word, value] : upper) value -= lower[word];
    return upper;
  }
};

// Only the words of A₁ alone may be left, up to the order: then the step is
// exp(Δt A₁) up to Δt^(order + 1).
TEST_P(CompositionTest, MeetsTheOrderConditionsToRoundOff) {
  Series bounds = RoundingBounds(order());
  for (const auto& [word, value] : Composed(order())) {
    EXPECT_LE(std::abs(value - Exact(word)), bounds[word]) << word;
  }
}

// One more order is not met: the test above can fail.
TEST_P(CompositionTest, DoesNotMeetTheConditionsOfTheNextOrder) {
  Series bounds = RoundingBounds(order() + 1);
  bool met = true;
  for (const auto& [word, value] : Composed(order() + 1)) {
    met = met && std::abs(value - Exact(word)) <= bounds[word];
  }
  EXPECT_FALSE(met);
}

TEST_P(CompositionTest, PartsAreAPalindromeOfPairsThatAddUpExactly) {
  for (const double time_step : {1.0, 1e-3, 0.1, -0.01, 3.7e-5, 1.0 / 3.0}) {
    const std::vector<double> parts = SubSteps(order(), time_step);
    // Of 64 bits, which hold the sums.
    long double sum = 0.0L;
    for (size_t i = 0; i < parts.size(); ++i) {
      sum += static_cast<long double>(parts[i]);
      EXPECT_EQ(parts[i], parts[parts.size() - 1 - i]);
      EXPECT_EQ(parts[i], parts[i ^ 1U]);
    }
    EXPECT_EQ(sum, static_cast<long double>(time_step));
    const std::vector<double> back = SubSteps(order(), -time_step);
    for (size_t i = 0; i < parts.size(); ++i) EXPECT_EQ(back[i], -parts[i]);
  }
}

TEST_P(CompositionTest, CountsWholeSteps) {
  TestRun run(ModelOf(PaperBox()), Options(0.1));
  ASSERT_TRUE(run.Advance(3));
  EXPECT_EQ(run.state().step, 3);
  TestRun second(ModelOf(PaperBox()), 0.1);
  ASSERT_TRUE(second.Advance(3));
  EXPECT_EQ(run.state().time.value, second.state().time.value);
  EXPECT_EQ(run.state().time.compensation, second.state().time.compensation);
}

TEST_P(CompositionTest, AStepThatConvergesAllocatesNothing) {
  TestRun run(ModelOf(PaperBox()), Options(1e-2));
  ExpectStepsAllocateNothing(run, 5);
}

// Whichever part fails: more iterations let more parts pass.
TEST_P(CompositionTest, AStepThatFailsLeavesTheStateInEveryBit) {
  std::vector<std::string> messages;
  for (int iterations = 1; iterations <= 12; ++iterations) {
    IntegratorOptions options = Options(0.3);
    options.max_iterations = iterations;
    TestRun run(Tangle(), Options(1e-3));
    ASSERT_TRUE(run.Advance(2));
    run.SetOptions(options);
    const State before = run.state();
    const StepReport report = run.Step();
    if (report.ok()) continue;
    EXPECT_TRUE(SameState(run.state(), before)) << report.message;
    EXPECT_EQ(report.message.rfind("part ", 0), 0U) << report.message;
    messages.push_back(report.message.substr(0, 7));
  }
  ASSERT_FALSE(messages.empty());
}

TEST_P(CompositionTest, APartThatFailsInTheMiddleUndoesThoseBefore) {
  // From a start that fits, longer parts are the first to lack iterations.
  bool seen = false;
  for (const double time_step : {0.25, 0.5, 1.0, 2.0}) {
    TestRun run(ModelOf(PaperBox(Formulation::kConventional)),
                Options(time_step));
    ASSERT_TRUE(run.Advance(1));
    const State before = run.state();
    for (int iterations = 2; iterations <= 12; ++iterations) {
      IntegratorOptions options = Options(time_step);
      options.max_iterations = iterations;
      run.SetOptions(options);
      run.state() = before;
      const StepReport report = run.Step();
      if (report.ok()) break;
      EXPECT_TRUE(SameState(run.state(), before)) << report.message;
      seen = seen || report.message.rfind("part 1 ", 0) != 0;
    }
  }
  EXPECT_TRUE(seen);
}

// A part changes velocities and strains by |ω| Δt of their size, with |ω| up to
// 1 rad/s, and rounds that by u each, at random.
TEST_P(CompositionTest, KeepsTheLawsOfStructures) {
  constexpr int kSteps = 200;
  constexpr double kStep = 5e-3;
  const auto parts_per_step =
      static_cast<int64_t>(SubSteps(order(), kStep).size());
  const double bound =
      RandomWalkBound(kSteps * parts_per_step, RoundoffBound(2, kStep));
  const ModelDescription box = BoxWithTruss();
  for (const ModelDescription& model :
       {box, BoxWithTruss(Formulation::kConventional), Tangle()}) {
    TestRun run(model, Options(kStep));
    const InvariantMonitor monitor = run.Watch(kSteps);
    EXPECT_LE(monitor.energy().max_relative_error(), bound);
    EXPECT_LE(monitor.angular_momentum().max_relative_error(), bound);
  }
}

// Falling exchanges all of the energy. Each part of that is rounded by u in the
// mean velocity, in its product with Δt, and in position and velocity: 4 u of
// the sum of all parts, forth and back, Σ|γ| < 4 times what is exchanged.
TEST_P(CompositionTest, CountsTheWorkOfLoads) {
  ModelDescription model = BoxWithTruss();
  model.gravity = {0.0, 0.0, -9.81};
  model.loads = {ForceLoad{NodePoint{"tip"}, {30.0, -20.0, 10.0}},
                 TorqueLoad{"box", {100.0, 200.0, -50.0}}};
  TestRun run(model, Options(5e-3));
  const InvariantMonitor monitor = run.Watch(200);
  EXPECT_GT(std::abs(monitor.latest().load_work.ToDouble()), 1.0);
  EXPECT_LE(monitor.energy().max_relative_error(), RoundoffBound(4 * 4, 1.0));
}

// Forth and back with the step reversed. The palindrome makes the way back the
// inverse; what remains is that each of N parts rounds the velocity by u of its
// increment, at most |ω|² Δt, at random, and that the body turns on with that
// for the rest of the time: a quaternion by half the angle.
TEST_P(CompositionTest, GoesBackTheWayItCame) {
  for (const Formulation formulation :
       {Formulation::kAncf, Formulation::kConventional}) {
    constexpr int kSteps = 100;
    constexpr double kStep = 0.05;
    TestRun run(ModelOf(PaperBox(formulation, 1e8)), Options(kStep));
    const Vector4d start = run.Motion().quaternion;
    const Vector3d omega = run.Motion().omega_locked;
    ASSERT_TRUE(run.Advance(kSteps));
    EXPECT_GT((run.Motion().quaternion - start).norm(), 0.1);
    run.SetOptions(Options(-kStep));
    ASSERT_TRUE(run.Advance(kSteps));
    const auto parts_per_step =
        static_cast<int64_t>(SubSteps(order(), kStep).size());
    const int64_t num_parts = 2 * kSteps * parts_per_step;
    const double bound = RandomWalkBound(
        num_parts, RoundoffBound(1, kStep * omega.squaredNorm()));
    EXPECT_LE((run.Motion().omega_locked - omega).norm(), bound);
    EXPECT_LE((run.Motion().quaternion - start).norm(),
              0.5 * 2 * kSteps * kStep * bound);
    EXPECT_EQ(run.state().time.value, 0.0);
  }
}

// The error is C h^p (1 + c h² + …), since a palindrome has even powers only,
// with c of the size of |ω|², the square of the only rate there is: so near to
// p is the order of a halving. Reference: order six with a quarter of the finer
// step, whose own error is 4⁻⁶ of what it is compared with, or less.
TEST_P(CompositionTest, HasTheOrderItSays) {
  constexpr double kStep = 0.25;
  const auto end = [](int order, double time_step) {
    TestRun run(ModelOf(PaperBox(Formulation::kConventional)),
                IntegratorOptions{.order = order, .time_step = time_step});
    EXPECT_TRUE(run.Advance(std::llround(8.0 / time_step)));
    return run.Motion().quaternion;
  };
  const Vector4d exact = end(6, kStep / 8);
  const double coarse = (end(order(), kStep) - exact).norm();
  const double fine = (end(order(), kStep / 2) - exact).norm();
  EXPECT_NEAR(std::log2(coarse / fine), order(),
              kStep * kStep * PaperBoxOmega().squaredNorm());
}

INSTANTIATE_TEST_SUITE_P(Orders, CompositionTest, ::testing::Values(4, 6),
                         [](const auto& order) {
                           return "Order" + std::to_string(order.param);
                         });

TEST(SecondOrderTest, IsTheStepItself) {
  EXPECT_EQ(SubSteps(2, 0.1), std::vector<double>{0.1});
}

}  // namespace
}  // namespace emmy
