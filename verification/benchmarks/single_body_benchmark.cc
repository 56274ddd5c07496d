// One body: the paper's box, free and with a truss, against Runge–Kutta.

#include <benchmark/benchmark.h>

#include <cmath>

#include "verification/benchmarks/checked_run.h"
#include "verification/benchmarks/runge_kutta_body.h"
#include "verification/runs/paper_box.h"

namespace emmy::verification {
namespace {

constexpr double kPenalty = 1e10;  // [Pa]

// In a million steps: the bound of the claim conservation/energy.
constexpr double kKept = 1e-15;

IntegratorOptions Options(bool full_newton = false) {
  IntegratorOptions options;
  options.time_step = kPaperTimeStep;
  options.always_full_newton = full_newton;
  return options;
}

void RungeKutta(benchmark::State& state) {
  RungeKuttaBody body({6750.0, 13500.0, 17550.0}, {0.3, 0.5, 0.8});
  const double start = body.Energy();
  for (auto _ : state) {
    body.Step(kPaperTimeStep);
    benchmark::DoNotOptimize(body);
  }
  const double error = std::abs(body.Energy() - start) / start;
  state.counters["energy_error"] = error;
  // A few million steps of round-off: far above it, something is wrong.
  if (!(error <= 1e-11)) state.SkipWithError("the energy is not kept");
}
BENCHMARK(RungeKutta)->Name("one_body/runge_kutta");

void AncfRelaxed(benchmark::State& state) {
  CheckedRun run(PaperBoxAncf(kPenalty, Start::kRelaxed), Options());
  run.TimeSteps(state, kKept);
}
BENCHMARK(AncfRelaxed)->Name("one_body/ancf_relaxed");

void AncfUndeformed(benchmark::State& state) {
  CheckedRun run(PaperBoxAncf(kPenalty), Options());
  run.TimeSteps(state, kKept);
}
BENCHMARK(AncfUndeformed)->Name("one_body/ancf_undeformed");

void AncfFullNewton(benchmark::State& state) {
  CheckedRun run(PaperBoxAncf(kPenalty), Options(/*full_newton=*/true));
  run.TimeSteps(state, kKept);
}
BENCHMARK(AncfFullNewton)->Name("one_body/ancf_full_newton");

void Conventional(benchmark::State& state) {
  CheckedRun run(PaperBoxConventional(), Options());
  run.TimeSteps(state, kKept);
}
BENCHMARK(Conventional)->Name("one_body/conventional");

void AncfTruss(benchmark::State& state) {
  CheckedRun run(PaperTrussAncf(kPenalty), Options());
  run.TimeSteps(state, kKept);
}
BENCHMARK(AncfTruss)->Name("box_and_truss/ancf");

void ConventionalTruss(benchmark::State& state) {
  CheckedRun run(PaperTrussConventional(), Options());
  run.TimeSteps(state, kKept);
}
BENCHMARK(ConventionalTruss)->Name("box_and_truss/conventional");

}  // namespace
}  // namespace emmy::verification
