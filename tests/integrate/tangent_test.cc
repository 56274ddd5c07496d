// The closed-form tangent is an approximation; the step it leads to is not.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

#include "tests/support/paper_box.h"
#include "tests/support/roundoff_bound.h"
#include "tests/support/test_run.h"

namespace emmy {
namespace {

struct Case {
  std::string name;
  RigidBodyDescription body;
  double time_step;
  friend void PrintTo(const Case& c, std::ostream* os) { *os << c.name; }
};

std::vector<Case> Cases() {
  std::vector<Case> cases;
  for (const int exponent : {4, 6, 8, 10, 12, 14}) {
    const double penalty = std::pow(10.0, exponent);
    const std::string suffix = std::to_string(exponent);
    RigidBodyDescription box = PaperBox(Formulation::kAncf, penalty);
    cases.push_back({"Box1e" + suffix, box, 1e-3});
    cases.push_back({"LargeStepBox1e" + suffix, box, 0.1});
    RigidBodyDescription tilted = box;
    Matrix3d tensor;
    tensor << 3000.0, 200.0, -100.0,  //
        200.0, 4000.0, 300.0,         //
        -100.0, 300.0, 5000.0;
    tilted.inertia =
        TensorInertia{.mass = 1000.0, .tensor = tensor, .volume = 0.5};
    tilted.orientation = RotationVector{{0.3, 0.2, -1.0}};
    cases.push_back({"GeneralAxes1e" + suffix, tilted, 0.01});
    cases.push_back({"LargeStepGeneralAxes1e" + suffix, tilted, 0.1});
    RigidBodyDescription uneven = tilted;
    uneven.penalty =
        std::array<double, 6>{penalty,       3.0 * penalty,  0.2 * penalty,
                              7.0 * penalty, 0.05 * penalty, 2.0 * penalty};
    cases.push_back({"SixPenalties1e" + suffix, uneven, 0.01});
  }
  return cases;
}

class TangentTest : public ::testing::TestWithParam<Case> {
 protected:
  static constexpr int kNumSteps = 200;

  // Largest distance of velocities relative to the largest one after one step
  // from the same state, along a motion.
  static double LargestDifference(const IntegratorOptions& options,
                                  const IntegratorOptions& other_options) {
    TestRun run(ModelOf(GetParam().body), options);
    TestRun other(ModelOf(GetParam().body), other_options);
    double largest = 0.0;
    for (int i = 0; i < kNumSteps; ++i) {
      other.state() = run.state();
      if (!run.Advance(1) || !other.Advance(1)) break;
      const CompensatedVector& v = run.state().velocity;
      const CompensatedVector& w = other.state().velocity;
      const VectorXd difference =
          (v.value - w.value) + (v.compensation - w.compensation);
      largest = std::max(largest, difference.cwiseAbs().maxCoeff() /
                                      v.value.cwiseAbs().maxCoeff());
    }
    return largest;
  }
};

// A strain increment of the size |ω|Δt is rounded by some u |ω|Δt, which a
// velocity of the same number of u |ω| undoes: that is how sharply the
// equations define the velocity, whoever solves them.
TEST_P(TangentTest, LeadsToTheStepOfNewtonsMethod) {
  EXPECT_LE(LargestDifference({.time_step = GetParam().time_step},
                              {.time_step = GetParam().time_step,
                               .always_full_newton = true}),
            RoundoffBound(32, 1.0));
}

// The check above sees an iteration that ends early.
TEST_P(TangentTest, ALooseToleranceDoesNotLeadToTheStepOfNewtonsMethod) {
  EXPECT_GT(
      LargestDifference(
          {.time_step = GetParam().time_step, .tolerance = 1e-3},
          {.time_step = GetParam().time_step, .always_full_newton = true}),
      RoundoffBound(32, 1.0));
}

INSTANTIATE_TEST_SUITE_P(Cases, TangentTest, ::testing::ValuesIn(Cases()),
                         [](const auto& c) { return c.param.name; });

}  // namespace
}  // namespace emmy
