// Nets and chains: cost against size, and what kept factors are worth.

#include <benchmark/benchmark.h>

#include <functional>
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"
#include "verification/benchmarks/checked_run.h"
#include "verification/models/large_models.h"

namespace emmy::verification {
namespace {

constexpr double kKept = 1e-15;  // As in the claims of the group `structures`.
constexpr double kTolerance = 1e-6;
// A step of a chain of 1000 boxes to that tolerance, besides: the work of what
// is left (EM-7) comes to 3e-19 to 7e-19 of the energy a step, from a hundred
// steps to 16,000. At a tolerance of 1e-4, where half of the steps take one
// iteration instead of two, it is 3e-14.
constexpr double kKeptPerStepToTolerance = 2e-18;

IntegratorOptions Options(double time_step) {
  IntegratorOptions options;
  options.time_step = time_step;
  return options;
}

struct Case {
  std::function<ModelDescription()> model;
  IntegratorOptions options;
  int warm_up = 10;  // Steps.
};

// Times a case. Its repetitions share one run, which begins again each time: to
// make a large one takes many times as long as its steps. Only the last is
// kept.
void Time(benchmark::State& state, const std::string& name, const Case& made,
          double bound_per_step = 0.0) {
  static std::string last;
  static std::unique_ptr<CheckedRun> run;
  const std::string key =
      absl::StrCat(name, "/", state.range(0), "/", made.options.time_step, "/",
                   made.options.num_threads);
  if (key != last) {
    run.reset();
    run =
        std::make_unique<CheckedRun>(made.model(), made.options, made.warm_up);
    last = key;
  }
  run->TimeSteps(state, kKept, bound_per_step);
}

// Arguments: nodes a side, time step in microseconds.
void Net(benchmark::State& state) {
  const auto side = static_cast<int>(state.range(0));
  Time(state, "net",
       {[side] { return SpinningNet(side).model; },
        Options(1e-6 * static_cast<double>(state.range(1)))});
}
BENCHMARK(Net)
    ->Name("net/kept_factor")
    ->ArgNames({"side", "step_us"})
    ->Args({30, 1000})
    ->Args({60, 1000})
    ->Args({60, 10000})
    ->Args({120, 1000})
    ->Unit(benchmark::kMillisecond);

// Arguments: nodes a side, threads. Few steps: building the model and its first
// factorisation take longer, and are not what is timed.
void LargeNet(benchmark::State& state) {
  IntegratorOptions options = Options(1e-3);
  options.num_threads = static_cast<int>(state.range(1));
  const auto side = static_cast<int>(state.range(0));
  Time(state, "large_net",
       {[side] { return SpinningNet(side).model; }, options});
}
BENCHMARK(LargeNet)
    ->Name("net/large")
    ->ArgNames({"side", "threads"})
    ->Args({300, 1})
    ->Args({300, 2})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(10);

// Newton's method with a fresh factorisation, by Eigen or CHOLMOD, in every
// iteration.
void FreshFactors(benchmark::State& state, SymmetricFactor::Method method) {
  IntegratorOptions options =
      Options(1e-6 * static_cast<double>(state.range(1)));
  options.always_full_newton = true;
  options.factor_method = method;
  const auto side = static_cast<int>(state.range(0));
  Time(state, absl::StrCat("fresh", static_cast<int>(method)),
       {[side] { return SpinningNet(side).model; }, options, /*warm_up=*/2});
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
  const auto size = static_cast<int>(state.range(0));
  Time(state, "chain",
       {[size] { return BoxChain(size).model; }, Options(1e-3)});
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
  const auto size = static_cast<int>(state.range(0));
  Time(state, "conventional_chain",
       {[size] { return ConventionalBoxChain(size).model; }, Options(1e-3)});
}
BENCHMARK(ConventionalChain)
    ->Name("chain/conventional")
    ->ArgName("boxes")
    ->Arg(10)
    ->Arg(100)
    ->Arg(1000)
    ->Unit(benchmark::kMicrosecond);

// One closed loop. Argument: boxes, and joints.
void Ring(benchmark::State& state) {
  const auto size = static_cast<int>(state.range(0));
  Time(state, "ring", {[size] { return BoxRing(size).model; }, Options(1e-3)});
}
BENCHMARK(Ring)->Name("ring")->ArgName("boxes")->Arg(100)->Arg(1000)->Unit(
    benchmark::kMicrosecond);

void ConventionalRing(benchmark::State& state) {
  const auto size = static_cast<int>(state.range(0));
  Time(state, "conventional_ring",
       {[size] { return ConventionalBoxRing(size).model; }, Options(1e-3)});
}
BENCHMARK(ConventionalRing)
    ->Name("ring/conventional")
    ->ArgName("boxes")
    ->Arg(100)
    ->Arg(1000)
    ->Unit(benchmark::kMicrosecond);

// What iterating to round-off costs: the same to a tolerance. Energy then errs
// by the work of what is left (EM-7).
void ChainToTolerance(benchmark::State& state) {
  IntegratorOptions options = Options(1e-3);
  options.tolerance = kTolerance;
  const auto size = static_cast<int>(state.range(0));
  Time(state, "chain_to_tolerance",
       {[size] { return BoxChain(size).model; }, options},
       kKeptPerStepToTolerance);
}
BENCHMARK(ChainToTolerance)
    ->Name("chain_to_tolerance")
    ->ArgName("boxes")
    ->Arg(1000)
    ->Unit(benchmark::kMicrosecond);

// Argument: threads. As long as a published chain, of 1,076,748 links. Start
// values are extrapolated from a history that takes some 14 steps to settle.
void LongChain(benchmark::State& state) {
  IntegratorOptions options = Options(1e-3);
  options.num_threads = static_cast<int>(state.range(0));
  Time(state, "long_chain",
       {[] { return BoxChain(1076748).model; }, options, /*warm_up=*/16});
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
  const auto size = static_cast<int>(state.range(0));
  Time(state, "grid", {[size] { return BoxGrid(size).model; }, Options(1e-3)});
}
BENCHMARK(Grid)->Name("grid")->ArgName("side")->Arg(10)->Arg(30)->Unit(
    benchmark::kMillisecond);
// As many steps as renew the factor some times.
BENCHMARK(Grid)
    ->Name("grid")
    ->ArgName("side")
    ->Arg(100)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(100);

void Tree(benchmark::State& state) {
  const auto size = static_cast<int>(state.range(0));
  Time(state, "tree", {[size] { return BoxTree(size).model; }, Options(1e-3)});
}
BENCHMARK(Tree)->Name("tree")->ArgName("boxes")->Arg(100)->Arg(1000)->Unit(
    benchmark::kMicrosecond);

void TrussedRow(benchmark::State& state) {
  const auto size = static_cast<int>(state.range(0));
  Time(state, "trussed",
       {[size] { return TrussedBoxes(size).model; }, Options(1e-3)});
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
