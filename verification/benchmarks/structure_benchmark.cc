// Nets and chains: cost against size, and what kept factors are worth.

#include <benchmark/benchmark.h>

#include "verification/benchmarks/checked_run.h"
#include "verification/models/large_models.h"

namespace emmy::verification {
namespace {

constexpr double kKept = 1e-15;  // As in the claims of the group `structures`.

IntegratorOptions Options(double time_step) {
  IntegratorOptions options;
  options.time_step = time_step;
  return options;
}

// Arguments: nodes a side, time step in microseconds.
void Net(benchmark::State& state) {
  CheckedRun run(SpinningNet(static_cast<int>(state.range(0))).model,
                 Options(1e-6 * static_cast<double>(state.range(1))),
                 /*warm_up=*/10);
  run.TimeSteps(state, kKept);
}
BENCHMARK(Net)
    ->Name("net/kept_factor")
    ->ArgNames({"side", "step_us"})
    ->Args({30, 1000})
    ->Args({60, 1000})
    ->Args({60, 10000})
    ->Args({120, 1000})
    ->Unit(benchmark::kMillisecond);

// Arguments: nodes a side, threads. Few steps: the factorisation alone takes
// minutes at this size on some machines, and is not what is timed.
void LargeNet(benchmark::State& state) {
  IntegratorOptions options = Options(1e-3);
  options.num_threads = static_cast<int>(state.range(1));
  CheckedRun run(SpinningNet(static_cast<int>(state.range(0))).model, options,
                 /*warm_up=*/10);
  run.TimeSteps(state, kKept);
}
BENCHMARK(LargeNet)
    ->Name("net/large")
    ->ArgNames({"side", "threads"})
    ->Args({300, 1})
    ->Args({300, 2})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(10);

// Newton's method with a fresh factorisation in every iteration.
void FreshFactors(benchmark::State& state, SymmetricFactor::Method method) {
  IntegratorOptions options =
      Options(1e-6 * static_cast<double>(state.range(1)));
  options.always_full_newton = true;
  options.factor_method = method;
  CheckedRun run(SpinningNet(static_cast<int>(state.range(0))).model, options,
                 /*warm_up=*/2);
  run.TimeSteps(state, kKept);
}
void FreshLdlt(benchmark::State& state) {
  FreshFactors(state, SymmetricFactor::Method::kSimplicial);
}
void FreshCholmod(benchmark::State& state) {
  FreshFactors(state, SymmetricFactor::Method::kSupernodal);
}
BENCHMARK(FreshLdlt)
    ->Name("net/fresh_ldlt")
    ->ArgNames({"side", "step_us"})
    ->Args({60, 1000})
    ->Args({60, 10000})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(3);
BENCHMARK(FreshCholmod)
    ->Name("net/fresh_cholmod")
    ->ArgNames({"side", "step_us"})
    ->Args({60, 1000})
    ->Args({60, 10000})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(3);

// Argument: boxes.
void Chain(benchmark::State& state) {
  CheckedRun run(BoxChain(static_cast<int>(state.range(0))).model,
                 Options(1e-3), /*warm_up=*/10);
  run.TimeSteps(state, kKept);
}
BENCHMARK(Chain)
    ->Name("chain")
    ->ArgName("boxes")
    ->Arg(10)
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000)
    ->Unit(benchmark::kMicrosecond);

// The same of conventional bodies: six coordinates a box instead of twelve, a
// matrix that is made anew in every step, and no lanes.
void ConventionalChain(benchmark::State& state) {
  CheckedRun run(ConventionalBoxChain(static_cast<int>(state.range(0))).model,
                 Options(1e-3), /*warm_up=*/10);
  run.TimeSteps(state, kKept);
}
BENCHMARK(ConventionalChain)
    ->Name("chain/conventional")
    ->ArgName("boxes")
    ->Arg(10)
    ->Arg(100)
    ->Arg(1000)
    ->Unit(benchmark::kMicrosecond);

// Argument: threads. As long as a published chain, of 1,076,748 links.
void LongChain(benchmark::State& state) {
  IntegratorOptions options = Options(1e-3);
  options.num_threads = static_cast<int>(state.range(0));
  CheckedRun run(BoxChain(1076748).model, options, /*warm_up=*/4);
  run.TimeSteps(state, kKept);
}
BENCHMARK(LongChain)
    ->Name("chain/long")
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(5);

// Argument: boxes a side; 2 n (n − 1) joints.
void Grid(benchmark::State& state) {
  CheckedRun run(BoxGrid(static_cast<int>(state.range(0))).model, Options(1e-3),
                 /*warm_up=*/10);
  run.TimeSteps(state, kKept);
}
BENCHMARK(Grid)
    ->Name("grid")
    ->ArgName("side")
    ->Arg(10)
    ->Arg(30)
    ->Arg(100)
    ->Unit(benchmark::kMillisecond);

void Tree(benchmark::State& state) {
  CheckedRun run(BoxTree(static_cast<int>(state.range(0))).model, Options(1e-3),
                 /*warm_up=*/10);
  run.TimeSteps(state, kKept);
}
BENCHMARK(Tree)->Name("tree")->ArgName("boxes")->Arg(100)->Arg(1000)->Unit(
    benchmark::kMicrosecond);

void TrussedRow(benchmark::State& state) {
  CheckedRun run(TrussedBoxes(static_cast<int>(state.range(0))).model,
                 Options(1e-3), /*warm_up=*/10);
  run.TimeSteps(state, kKept);
}
BENCHMARK(TrussedRow)
    ->Name("trussed_boxes")
    ->ArgName("boxes")
    ->Arg(10)
    ->Arg(100)
    ->Arg(1000)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace emmy::verification
