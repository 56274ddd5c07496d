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
#include "emmy/base/larger.h"
#include "emmy/diagnostics/invariant_monitor.h"
#include "emmy/integrate/body_batch.h"
#include "emmy/model/model_builder.h"
#include "verification/models/body_state.h"
#include "verification/runs/paper_box.h"

namespace emmy::verification {
namespace {

constexpr double kPenalty = 1e10;  // [Pa]
constexpr int kStepsPerCall = 10;

// In a million steps, by each body: the bound of the claim conservation/energy.
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

struct WorstErrors {
  double energy = 0.0;
  double angular_momentum = 0.0;
};

// Of any body, relative to its own: in a sum over the batch errors would
// cancel, and one wrong body among many would not show.
WorstErrors ErrorsOf(const Model& model, const State& start, const State& end,
                     bool ancf) {
  // The bodies differ in their state alone.
  const BuiltModel one = BuildModel(Boxes(1, ancf)).value();
  State first = one.state;
  State last = one.state;
  WorstErrors worst;
  for (const ModelBody& body : model.bodies()) {
    CopyBody(body, start, &first);
    CopyBody(body, end, &last);
    InvariantMonitor monitor(one.model, first);
    monitor.Observe(last);
    worst.energy = Larger(worst.energy, monitor.energy().max_relative_error());
    worst.angular_momentum =
        Larger(worst.angular_momentum,
               monitor.angular_momentum().max_relative_error());
  }
  return worst;
}

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
  State start = built->state;
  batch->Store(&start);
  int64_t iterations = 0;
  for (auto _ : state) {
    const BatchReport report = batch->Step(kStepsPerCall);
    iterations += report.iterations;
    ok = ok && report.ok();
  }
  State end = built->state;
  batch->Store(&end);
  const WorstErrors worst = ErrorsOf(built->model, start, end, ancf);
  // Written so that NaN fails.
  if (!ok || !(worst.energy <= kKept) || !(worst.angular_momentum <= kKept)) {
    state.SkipWithError(absl::StrCat("energy error ", worst.energy,
                                     ", angular momentum error ",
                                     worst.angular_momentum)
                            .c_str());
  }
  const double body_steps = static_cast<double>(state.iterations()) *
                            kStepsPerCall * static_cast<double>(count);
  state.counters["newton_iterations"] =
      static_cast<double>(iterations) / body_steps;
  state.counters["energy_error"] = worst.energy;
  state.counters["angular_momentum_error"] = worst.angular_momentum;
  // By which timing.cc divides times.
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
