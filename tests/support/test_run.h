// A model with its state and integrator, in one object that may be moved.

#ifndef EMMY_TESTS_SUPPORT_TEST_RUN_H_
#define EMMY_TESTS_SUPPORT_TEST_RUN_H_

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "emmy/diagnostics/body_motion.h"
#include "emmy/diagnostics/invariant_monitor.h"
#include "emmy/integrate/energy_momentum.h"
#include "emmy/model/model_builder.h"

namespace emmy {

class TestRun {
 public:
  // A description or options that are refused end the test with the message
  // (absl::StatusOr stops the program).
  TestRun(const ModelDescription& description, const IntegratorOptions& options)
      : built_(std::make_unique<BuiltModel>(BuildModel(description).value())),
        integrator_(
            EnergyMomentumIntegrator::Create(built_->model, options).value()) {}

  TestRun(const ModelDescription& description, double time_step)
      : TestRun(description, IntegratorOptions{.time_step = time_step}) {}

  const Model& model() const { return built_->model; }
  State& state() { return built_->state; }
  const State& state() const { return built_->state; }

  StepReport Step() { return integrator_.Step(built_->state); }
  int num_factorizations() const { return integrator_.num_factorizations(); }

  // False, and a test failure with the message, if a step fails.
  bool Advance(int64_t num_steps) {
    for (int64_t i = 0; i < num_steps; ++i) {
      const StepReport report = Step();
      if (!report.ok()) {
        ADD_FAILURE() << report.message;
        return false;
      }
    }
    return true;
  }

  // The same with every `every`-th state observed by a monitor.
  InvariantMonitor Watch(int64_t num_steps, int64_t every = 1) {
    InvariantMonitor monitor(model(), state());
    for (int64_t i = 0; i < num_steps; i += every) {
      if (!Advance(every)) break;
      monitor.Observe(state());
    }
    return monitor;
  }

  // Goes on from here with other options (a negative time step: back).
  void SetOptions(const IntegratorOptions& options) {
    integrator_ =
        EnergyMomentumIntegrator::Create(built_->model, options).value();
  }

  BodyMotion Motion(size_t body = 0) const {
    return ObserveBody(model(), state(), body);
  }

 private:
  std::unique_ptr<BuiltModel> built_;
  EnergyMomentumIntegrator integrator_;
};

// True if coordinates, velocities and strains agree in every bit that a
// comparison sees (−0 equals 0), compensations included.
inline bool SameMotion(const State& a, const State& b) {
  return a.position.value == b.position.value &&
         a.position.compensation == b.position.compensation &&
         a.velocity.value == b.velocity.value &&
         a.velocity.compensation == b.velocity.compensation &&
         a.strain.value == b.strain.value &&
         a.strain.compensation == b.strain.compensation &&
         a.end_velocity.value == b.end_velocity.value &&
         a.end_velocity.compensation == b.end_velocity.compensation;
}

// The same for time, step number and iteration start too.
inline bool SameState(const State& a, const State& b) {
  return SameMotion(a, b) && a.step == b.step && a.time.value == b.time.value &&
         a.time.compensation == b.time.compensation &&
         a.load_work.value == b.load_work.value &&
         a.acceleration.next == b.acceleration.next &&
         a.acceleration.differences == b.acceleration.differences &&
         a.multiplier.next == b.multiplier.next &&
         a.multiplier.differences == b.multiplier.differences;
}

// The largest difference of coordinates.
inline double LargestDifference(const State& a, const State& b) {
  return (a.position.value - b.position.value).cwiseAbs().maxCoeff();
}

// So many steps from the start, which move something by more than `moved`, and
// as many back: to where it was but for rounding.
inline void ExpectRunsBack(const ModelDescription& model, double time_step,
                           int64_t num_steps, double moved) {
  TestRun run(model, time_step);
  const State start = run.state();
  ASSERT_TRUE(run.Advance(num_steps));
  EXPECT_GT(LargestDifference(run.state(), start), moved);
  run.SetOptions({.time_step = -time_step});
  ASSERT_TRUE(run.Advance(num_steps));
  EXPECT_LE(LargestDifference(run.state(), start), 1e-12);
}

}  // namespace emmy

#endif  // EMMY_TESTS_SUPPORT_TEST_RUN_H_
