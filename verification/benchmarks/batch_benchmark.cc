// Batches of free bodies. One iteration is ten steps of all bodies; the counter
// `body_steps` says how many steps of one body that is.

#include <benchmark/benchmark.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "emmy/diagnostics/invariant_monitor.h"
#include "emmy/integrate/body_batch.h"
#include "emmy/model/model_builder.h"
#include "verification/runs/paper_box.h"

namespace emmy::verification {
namespace {

constexpr double kPenalty = 1e10;  // [Pa]
constexpr int kStepsPerCall = 10;

// In a million steps: the bound of the claim conservation/energy.
constexpr double kKept = 1e-15;

// The paper's box `count` times, no two with the same angular velocity.
ModelDescription Boxes(int count, bool ancf) {
  const ModelDescription one =
      ancf ? PaperBoxAncf(kPenalty, Start::kRelaxed) : PaperBoxConventional();
  ModelDescription all;
  for (int i = 0; i < count; ++i) {
    RigidBodyDescription body = one.rigid_bodies[0];
    body.name = absl::StrCat("box_", i);
    const double factor = 1.0 + 0.3 * std::sin(static_cast<double>(i));
    body.angular_velocity = {0.3 * factor, 0.5, 0.8 / factor};
    all.rigid_bodies.push_back(std::move(body));
  }
  return all;
}

// Sets the instruction set for its lifetime; 0: the best there is.
class InstructionSet {
 public:
  explicit InstructionSet(int64_t target) { Choose(target); }
  ~InstructionSet() { Choose(0); }
  InstructionSet(const InstructionSet&) = delete;
  InstructionSet& operator=(const InstructionSet&) = delete;

 private:
  static void Choose(int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

void TimeBatch(benchmark::State& state, bool ancf, int64_t target) {
  const InstructionSet instructions(target);
  const auto count = static_cast<int>(state.range(0));
  absl::StatusOr<BuiltModel> built = BuildModel(Boxes(count, ancf));
  if (!built.ok()) {
    state.SkipWithError(built.status().ToString().c_str());
    return;
  }
  absl::StatusOr<BodyBatch> batch = BodyBatch::Create(
      built->model, {.time_step = kPaperTimeStep,
                     .num_threads = static_cast<int>(state.range(1))});
  if (!batch.ok()) {
    state.SkipWithError(batch.status().ToString().c_str());
    return;
  }
  batch->Load(built->state);
  bool ok = batch->Step(100).ok();  // Start values as in a long run.
  State now = built->state;
  batch->Store(&now);
  InvariantMonitor monitor(built->model, now);
  int64_t iterations = 0;
  for (auto _ : state) {
    const BatchReport report = batch->Step(kStepsPerCall);
    iterations += report.iterations;
    ok = ok && report.ok();
  }
  batch->Store(&now);
  monitor.Observe(now);
  const double energy = monitor.energy().max_relative_error();
  const double angular = monitor.angular_momentum().max_relative_error();
  if (!ok || !(std::max(energy, angular) <= kKept)) {
    state.SkipWithError(absl::StrCat("energy error ", energy,
                                     ", angular momentum error ", angular)
                            .c_str());
  }
  const double body_steps = static_cast<double>(state.iterations()) *
                            kStepsPerCall * static_cast<double>(count);
  state.counters["newton_iterations"] =
      static_cast<double>(iterations) / body_steps;
  state.counters["energy_error"] = energy;
  state.counters["angular_momentum_error"] = angular;
  // By which timing_report.cc divides times.
  state.counters["body_steps"] = kStepsPerCall * static_cast<double>(count);
}

using Sizes = std::vector<int64_t>;

void Register(const std::string& name, bool ancf, int64_t target,
              const Sizes& sizes) {
  // What this processor lacks is left out, and reported as not measured.
  if (target != 0 && (hwy::SupportedTargets() & target) == 0) return;
  benchmark::internal::Benchmark* const batch = benchmark::RegisterBenchmark(
      name.c_str(), [ancf, target](benchmark::State& state) {
        TimeBatch(state, ancf, target);
      });
  batch->ArgNames({"bodies", "threads"});
  for (const int64_t size : sizes) batch->Args({size, 1});
}

bool RegisterAll() {
  Register("batch/ancf", true, 0, {1000, 100000});
  Register("batch/ancf_avx512", true, HWY_AVX3, {1000});
  Register("batch/ancf_avx2", true, HWY_AVX2, {1000});
  Register("batch/ancf_sse4", true, HWY_SSE4, {1000});
  Register("batch/conventional", false, 0, {1000, 100000});
  // Processor time would add up the threads', so the clock is what counts.
  benchmark::RegisterBenchmark(
      "batch_clock/ancf",
      [](benchmark::State& state) { TimeBatch(state, true, 0); })
      ->ArgNames({"bodies", "threads"})
      ->Args({20000, 1})
      ->Args({20000, 2})
      ->UseRealTime();
  return true;
}

[[maybe_unused]] const bool kRegistered = RegisterAll();

}  // namespace
}  // namespace emmy::verification
