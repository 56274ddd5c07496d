// Runs in several threads: integrators share a constant model, or nothing but
// the library, and give the bits of one thread. Under the preset tsan
// (tools/sanitize) shared state that is written to would be found.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "emmy/diagnostics/invariant_monitor.h"
#include "emmy/integrate/energy_momentum.h"
#include "emmy/io/case_file.h"
#include "emmy/io/case_writer.h"
#include "emmy/model/model_builder.h"
#include "tests/support/structures.h"
#include "tests/support/test_run.h"

namespace emmy {
namespace {

constexpr int kThreads = 4;
constexpr int64_t kSteps = 30;

struct End {
  State state;
  double energy_error = 0.0;
  double energy = 0.0;
};

End RunOnce(const Model& model, const State& start) {
  End end{.state = start};
  EnergyMomentumIntegrator integrator =
      EnergyMomentumIntegrator::Create(model, {.time_step = 1e-3}).value();
  InvariantMonitor monitor(model, start);
  for (int64_t i = 0; i < kSteps && integrator.Step(end.state).ok(); ++i) {
    monitor.Observe(end.state);
  }
  end.energy_error = monitor.energy().max_error;
  end.energy = monitor.energy().final;
  return end;
}

void InThreads(const std::function<void(int)>& work) {
  std::vector<std::thread> threads;
  for (int i = 0; i < kThreads; ++i) threads.emplace_back(work, i);
  for (std::thread& thread : threads) thread.join();
}

void ExpectSameEnd(const End& end, const End& expected) {
  EXPECT_EQ(end.state.step, kSteps);
  EXPECT_TRUE(SameState(end.state, expected.state));
  EXPECT_EQ(end.energy_error, expected.energy_error);
  EXPECT_EQ(end.energy, expected.energy);
}

struct Part {
  const char* name;
  ModelDescription model;
};

std::vector<Part> Parts() {
  return {{"AncfBody", ModelOf(PaperBox())},
          {"ConventionalBody", ModelOf(PaperBox(Formulation::kConventional))},
          {"BodyWithTruss", BoxWithTruss()},
          {"ConventionalWithTruss", BoxWithTruss(Formulation::kConventional)},
          {"Tangle", Tangle()}};
}

TEST(ThreadsTest, ShareAModelThatIsConstant) {
  for (const Part& part : Parts()) {
    SCOPED_TRACE(part.name);
    const BuiltModel built = BuildModel(part.model).value();
    const End alone = RunOnce(built.model, built.state);
    std::array<End, kThreads> ends;
    InThreads([&](int i) {
      ends[static_cast<size_t>(i)] = RunOnce(built.model, built.state);
    });
    for (const End& end : ends) ExpectSameEnd(end, alone);
  }
}

// From text to result, so that reading and building are covered too.
TEST(ThreadsTest, DoEverythingBySeparateObjects) {
  Case value;
  value.name = "tangle";
  value.model = Tangle();
  value.integrator.time_step = 1e-3;
  value.integrator.duration = 1.0;
  const std::string text = WriteCase(value);
  const auto run = [&text] {
    const LoadedCase loaded = BuildCase(ParseCase(text).value()).value();
    return RunOnce(loaded.model, loaded.state);
  };
  const End alone = run();
  std::array<End, kThreads> ends;
  InThreads([&](int i) { ends[static_cast<size_t>(i)] = run(); });
  for (const End& end : ends) ExpectSameEnd(end, alone);
}

}  // namespace
}  // namespace emmy
