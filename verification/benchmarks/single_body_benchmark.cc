// One body: the paper's box, free and with a truss, against Runge–Kutta.

#include <benchmark/benchmark.h>

#include <cmath>

#include "emmy/base/compensated_sum.h"
#include "emmy/base/types.h"
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

// What iterating to round-off costs: the same to a tolerance. Energy then errs
// by the work of what is left (EM-7), which is of one sign and adds up like the
// number of steps: 3.7e-20 of the energy a step, from a thousand steps to five
// million. The bound is three times that; at a tolerance of 1e-3, where some
// steps take one iteration instead of two, it is 1e-14 a step.
constexpr double kKeptPerStepToTolerance = 1e-19;

void AncfToTolerance(benchmark::State& state) {
  IntegratorOptions options = Options();
  options.tolerance = 1e-6;
  CheckedRun run(PaperBoxAncf(kPenalty), options);
  run.TimeSteps(state, kKept, kKeptPerStepToTolerance);
}
BENCHMARK(AncfToTolerance)->Name("one_body/ancf_to_tolerance");

// What compensation costs: the 30 numbers of an ANCF body are advanced, by
// (SUM-2) and by additions.
constexpr Eigen::Index kNumbers = 30;

void CompensatedSums(benchmark::State& state) {
  CompensatedVector sums;
  sums.value = VectorXd::LinSpaced(kNumbers, 1.0, 2.0);
  sums.compensation = VectorXd::Zero(kNumbers);
  const VectorXd increment = VectorXd::LinSpaced(kNumbers, 1e-3, 2e-3);
  for (auto _ : state) {
    for (Eigen::Index i = 0; i < kNumbers; ++i) {
      AddCompensated(increment(i), sums.value(i), sums.compensation(i));
    }
    benchmark::DoNotOptimize(sums.value.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(CompensatedSums)->Name("sums/compensated");

void PlainSums(benchmark::State& state) {
  VectorXd sums = VectorXd::LinSpaced(kNumbers, 1.0, 2.0);
  const VectorXd increment = VectorXd::LinSpaced(kNumbers, 1e-3, 2e-3);
  for (auto _ : state) {
    sums += increment;
    benchmark::DoNotOptimize(sums.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(PlainSums)->Name("sums/plain");

}  // namespace
}  // namespace emmy::verification
