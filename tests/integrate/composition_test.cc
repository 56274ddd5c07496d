// What composed steps of order four and six promise beside the laws.

#include "emmy/integrate/composition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "emmy/numerics/rotation.h"
#include "tests/integrate/allocation_counter.h"
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

class CompositionTest : public ::testing::TestWithParam<int> {
 protected:
  int order() const { return GetParam(); }
  IntegratorOptions Options(double time_step) const {
    return {.order = order(), .time_step = time_step};
  }
};

// Only the words of A₁ alone may be left, up to the order: then the step is
// exp(Δt A₁) up to Δt^(order + 1). The conditions are on sums of products of
// γ, each of which is rounded by u; in all the sums of absolute values are
// below 30.
TEST_P(CompositionTest, MeetsTheOrderConditionsToRoundOff) {
  Series series = {{"", 1.0L}};
  for (const double h : SubSteps(order(), 1.0)) {
    series = Product(series, Exponential(static_cast<long double>(h), order()),
                     order());
  }
  for (const auto& [word, value] : series) {
    long double expected = 0.0L;
    if (word.find_first_not_of('1') == std::string::npos) {
      expected = 1.0L / std::tgamma(static_cast<long double>(word.size()) + 1);
    }
    EXPECT_NEAR(static_cast<double>(value - expected), 0.0, 30 * 0x1p-53)
        << word;
  }
}

// One more order is not met: the test above can fail.
TEST_P(CompositionTest, DoesNotMeetTheConditionsOfTheNextOrder) {
  Series series = {{"", 1.0L}};
  for (const double h : SubSteps(order(), 1.0)) {
    series =
        Product(series, Exponential(static_cast<long double>(h), order() + 1),
                order() + 1);
  }
  long double largest = 0.0L;
  for (const auto& [word, value] : series) {
    if (word.find_first_not_of('1') == std::string::npos) continue;
    largest = std::max(largest, std::abs(value));
  }
  EXPECT_GT(largest, 1e-5L);
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
  bool ok = true;
  const AllocationCount before = AllocationsSoFar();
  for (int i = 0; i < 5; ++i) ok = run.Step().ok() && ok;
  const AllocationCount after = AllocationsSoFar();
  EXPECT_TRUE(ok);
  EXPECT_EQ(after.malloc, before.malloc);
  EXPECT_EQ(after.new_, before.new_);
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

TEST_P(CompositionTest, KeepsTheLawsOfStructures) {
  const ModelDescription box = BoxWithTruss();
  for (const ModelDescription& model :
       {box, BoxWithTruss(Formulation::kConventional), Tangle()}) {
    TestRun run(model, Options(5e-3));
    const InvariantMonitor monitor = run.Watch(200);
    // As for single steps: nine roundings.
    EXPECT_LE(monitor.energy().max_relative_error(), 1e-15);
    EXPECT_LE(monitor.angular_momentum().max_relative_error(), 1e-15);
  }
}

TEST_P(CompositionTest, CountsTheWorkOfLoads) {
  ModelDescription model = BoxWithTruss();
  model.gravity = {0.0, 0.0, -9.81};
  model.loads = {ForceLoad{NodePoint{"tip"}, {30.0, -20.0, 10.0}},
                 TorqueLoad{"box", {100.0, 200.0, -50.0}}};
  TestRun run(model, Options(5e-3));
  const InvariantMonitor monitor = run.Watch(200);
  EXPECT_GT(std::abs(monitor.latest().load_work.ToDouble()), 1.0);
  EXPECT_LE(monitor.energy().max_relative_error(), 1e-14);
}

// Forth and back with the step reversed. The palindrome makes the way back the
// inverse; what remains is that each of N parts rounds by u of its increments,
// and turns on with the error of ω for the rest of the time.
TEST_P(CompositionTest, GoesBackTheWayItCame) {
  for (const Formulation formulation :
       {Formulation::kAncf, Formulation::kConventional}) {
    constexpr int kSteps = 100;
    TestRun run(ModelOf(PaperBox(formulation, 1e8)), Options(0.05));
    const Vector4d start = run.Motion().quaternion;
    const Vector3d omega = run.Motion().omega_locked;
    ASSERT_TRUE(run.Advance(kSteps));
    EXPECT_GT((run.Motion().quaternion - start).norm(), 0.1);
    run.SetOptions(Options(-0.05));
    ASSERT_TRUE(run.Advance(kSteps));
    EXPECT_LE((run.Motion().quaternion - start).norm(), 1e-13);
    EXPECT_LE((run.Motion().omega_locked - omega).norm(), 1e-13);
    EXPECT_EQ(run.state().time.value, 0.0);
  }
}

// The error falls by 2^order when the step is halved, in a smooth problem;
// reference: a step of a sixteenth.
TEST_P(CompositionTest, HasTheOrderItSays) {
  const auto end = [this](double time_step) {
    TestRun run(ModelOf(PaperBox(Formulation::kConventional)),
                Options(time_step));
    EXPECT_TRUE(run.Advance(std::llround(8.0 / time_step)));
    return run.Motion();
  };
  const Vector4d exact = end(0.5 / 16).quaternion;
  const double coarse = (end(0.5).quaternion - exact).norm();
  const double fine = (end(0.25).quaternion - exact).norm();
  EXPECT_NEAR(std::log2(coarse / fine), order(), 0.3);
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
