#include "verification/timing/timing_report.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "verification/runs/fit.h"

namespace emmy::verification {
namespace {

constexpr char kYardstick[] = "one_body/runge_kutta";

}  // namespace

std::string CounterText(const Timing& timing, const std::string& name,
                        bool is_error) {
  const auto counter = timing.counters.find(name);
  if (counter == timing.counters.end()) return "–";
  return is_error ? absl::StrFormat("%.1e", counter->second)
                  : absl::StrFormat("%.3g", counter->second);
}

std::string RatioTable(const TimingRun& run, const std::vector<Ratio>& ratios) {
  std::string text =
      "| what | ratio | target | | where that comes from |\n| --- | --- | --- "
      "| --- | --- |\n";
  for (const Ratio& ratio : ratios) {
    const Timing* numerator = run.Find(ratio.numerator);
    const Timing* denominator = run.Find(ratio.denominator);
    const double divisor =
        denominator != nullptr ? denominator->median : ratio.published;
    const char* const sign = ratio.at_least ? ">=" : "<=";
    if (numerator == nullptr || divisor == 0.0) {
      absl::StrAppendFormat(&text, "| %s | not measured | %s %g | | %s |\n",
                            ratio.sentence, sign, ratio.target, ratio.basis);
      continue;
    }
    const double value = numerator->median / divisor;
    const bool met =
        ratio.at_least ? value >= ratio.target : value <= ratio.target;
    absl::StrAppendFormat(&text, "| %s | %.3g | %s %g | %s | %s |\n",
                          ratio.sentence, value, sign, ratio.target,
                          met ? "met" : "**missed**", ratio.basis);
  }
  return text;
}

namespace {

std::string GrowthRows(const TimingRun& run) {
  std::string text =
      "| what | exponent | target | | where that comes from |\n| --- | --- | "
      "--- | --- | --- |\n";
  for (const Growth& growth : Growths()) {
    std::vector<double> sizes;
    std::vector<double> times;
    for (const auto& [size, name] : growth.sizes) {
      const Timing* timing = run.Find(name);
      if (timing == nullptr) continue;
      sizes.push_back(size);
      times.push_back(timing->median);
    }
    if (sizes.size() < growth.sizes.size()) {
      absl::StrAppendFormat(&text, "| %s | not measured | <= %g | | %s |\n",
                            growth.sentence, growth.target, growth.basis);
      continue;
    }
    const double exponent = FitPower(sizes, times);
    absl::StrAppendFormat(&text, "| %s | %.2f | <= %g | %s | %s |\n",
                          growth.sentence, exponent, growth.target,
                          exponent <= growth.target ? "met" : "**missed**",
                          growth.basis);
  }
  return text;
}

std::string TimeRows(const TimingRun& run) {
  std::string text =
      "| benchmark | median | spread | iterations | energy error | angular "
      "momentum error |\n| --- | --- | --- | --- | --- | --- |\n";
  for (const Timing& timing : run.timings) {
    if (!timing.error.empty()) {
      absl::StrAppendFormat(&text, "| `%s` | failed: %s | | | | |\n",
                            timing.name, timing.error);
      continue;
    }
    absl::StrAppendFormat(&text, "| `%s` | %s | %.0f %% | %s | %s | %s |\n",
                          timing.name, TimeText(timing.median),
                          100.0 * timing.spread,
                          CounterText(timing, "newton_iterations", false),
                          CounterText(timing, "energy_error", true),
                          CounterText(timing, "angular_momentum_error", true));
  }
  return text;
}

}  // namespace

std::string TimeText(double nanoseconds) {
  if (nanoseconds < 1e3) return absl::StrFormat("%.0f ns", nanoseconds);
  if (nanoseconds < 1e6) return absl::StrFormat("%.3g us", 1e-3 * nanoseconds);
  if (nanoseconds < 1e9) return absl::StrFormat("%.3g ms", 1e-6 * nanoseconds);
  return absl::StrFormat("%.3g s", 1e-9 * nanoseconds);
}

const std::vector<Ratio>& Ratios() {
  static const std::vector<Ratio>* const ratios = new std::vector<Ratio>{
      {"one ANCF body, relaxed start, over Runge-Kutta",
       "one_body/ancf_relaxed", kYardstick, 3.0, false,
       "set: exact laws for three steps that drift"},
      {"one ANCF body, undeformed start, over Runge-Kutta",
       "one_body/ancf_undeformed", kYardstick, 5.5, false,
       "set: as relaxed, and more iterations while the penalty vibrates"},
      {"one conventional body over Runge-Kutta", "one_body/conventional",
       kYardstick, 1.3, false,
       "set: one correction in pairs of doubles for four evaluations in "
       "doubles"},
      {"batch of 1000 ANCF bodies, AVX-512, a body, over Runge-Kutta",
       "batch/ancf_avx512/bodies:1000/threads:1", kYardstick, 0.45, false,
       "set: 3.6 times the work of a body, over eight lanes"},
      {"batch of 1000 ANCF bodies, AVX2, a body, over Runge-Kutta",
       "batch/ancf_avx2/bodies:1000/threads:1", kYardstick, 0.9, false,
       "set: 3.6 times the work of a body, over four lanes"},
      {"batch of 100,000 ANCF bodies over one of 1000, a body",
       "batch/ancf/bodies:100000/threads:1", "batch/ancf/bodies:1000/threads:1",
       1.3, false, "set: memory is passed once a call, not once a step"},
      {"batch of 1000 conventional bodies, a body, over Runge-Kutta",
       "batch/conventional/bodies:1000/threads:1", kYardstick, 0.12, false,
       "set: less than the work of a Runge-Kutta step over eight lanes, 0.125"},
      {"batch of 20,000 ANCF bodies: one thread over two",
       "batch_clock/ancf/bodies:20000/threads:1",
       "batch_clock/ancf/bodies:20000/threads:2", 1.8, true,
       "set: two that share nothing; a tenth less for beginning and end"},
      {"box and truss, ANCF, over Runge-Kutta", "box_and_truss/ancf",
       kYardstick, 25.0, false, "set"},
      {"box and truss: conventional over ANCF", "box_and_truss/conventional",
       "box_and_truss/ancf", 1.0, true,
       "set: a constant inverse (LANE-5) should not be slower than a mass that "
       "turns"},
      {"net 60 x 60, 1 ms: fresh factors of Eigen's LDLT over a kept one",
       "net/fresh_ldlt/side:60/step_us:1000",
       "net/kept_factor/side:60/step_us:1000", 20.0, true,
       "set: a fifth of sqrt(N), see the next"},
      {"net 60 x 60, 1 ms: fresh CHOLMOD factors over a kept one",
       "net/fresh_cholmod/side:60/step_us:1000",
       "net/kept_factor/side:60/step_us:1000", 50.0, true,
       "set: half of sqrt(N) = 104 of N = 10,800 unknowns, by which "
       "factorising "
       "(N^1.5) outgrows solving (N log N)"},
      {"net 60 x 60, 10 ms: fresh CHOLMOD factors over a kept one",
       "net/fresh_cholmod/side:60/step_us:10000",
       "net/kept_factor/side:60/step_us:10000", 25.0, true,
       "set: half of that at 1 ms, with twice as many iterations a factor"},
      {"net 300 x 300: one thread over two", "net/large/side:300/threads:1",
       "net/large/side:300/threads:2", 1.4, true,
       "set: four fifths of the work shared, the rest done by one"},
      {"chain of 1,076,748 boxes over 0.84 us a box", "chain/long/threads:1",
       "", 1.0, false,
       "published for a dissipative solver of one iteration, on its authors' "
       "machine (M-ABD, arXiv 2603.08079)",
       840.0 * 1076748.0},
      {"chain of 1,076,748 boxes, one thread over two", "chain/long/threads:1",
       "chain/long/threads:2", 1.6, true,
       "set: two; a fifth less for what one thread does alone"},
      {"grid of 100 x 100 boxes, 19,800 joints, over a chain of 1000",
       "grid/side:100", "chain/boxes:1000", 119.0, false,
       "set: 19.8 times the joints, six times as much a joint"},
      {"closed loop of 1000 boxes over a chain of 1000", "ring/boxes:1000",
       "chain/boxes:1000", 6.0, false,
       "set: as many joints, six times as much a joint"},
      {"closed loop of 1000 conventional boxes over a chain of them",
       "ring/conventional/boxes:1000", "chain/conventional/boxes:1000", 6.0,
       false, "set: as many joints, six times as much a joint"},
      {"one ANCF body, to round-off over to 1e-6 of its velocities",
       "one_body/ancf_undeformed", "one_body/ancf_to_tolerance", 2.0, false,
       "set: two iterations reach 1e-6, one or two more round-off"},
      {"chain of 1000 boxes, to round-off over to 1e-6", "chain/boxes:1000",
       "chain_to_tolerance/boxes:1000", 2.0, false,
       "set: two iterations reach 1e-6, one or two more round-off"},
      {"sums of one body's 30 numbers, compensated over plain",
       "sums/compensated", "sums/plain", 7.0, false,
       "set: seven operations a number (SUM-2) for one"},
  };
  return *ratios;
}

const std::vector<Growth>& Growths() {
  static const std::vector<Growth>* const growths = new std::vector<Growth>{
      {"net, 30 to 300 nodes a side, by the number of nodes",
       {{900.0, "net/kept_factor/side:30/step_us:1000"},
        {3600.0, "net/kept_factor/side:60/step_us:1000"},
        {14400.0, "net/kept_factor/side:120/step_us:1000"},
        {90000.0, "net/large/side:300/threads:1"}},
       1.3,
       "set: 1.11 for N log N over these sizes, the rest for caches"},
      {"chain of joined boxes, 100 to 10,000, by boxes",
       {{100.0, "chain/boxes:100"},
        {1000.0, "chain/boxes:1000"},
        {10000.0, "chain/boxes:10000"}},
       1.1,
       "set: every box is the same work; a tenth for caches"},
      {"closed loop of joined boxes, 100 to 1000, by boxes",
       {{100.0, "ring/boxes:100"}, {1000.0, "ring/boxes:1000"}},
       1.1,
       "set: every box is the same work; a tenth for caches"},
      {"tree of joined boxes, 100 to 1000, by boxes",
       {{100.0, "tree/boxes:100"}, {1000.0, "tree/boxes:1000"}},
       1.1,
       "set: every box is the same work; a tenth for caches"},
      {"row of boxes joined by trusses, 10 to 1000, by boxes",
       {{10.0, "trussed_boxes/boxes:10"},
        {100.0, "trussed_boxes/boxes:100"},
        {1000.0, "trussed_boxes/boxes:1000"}},
       1.1,
       "set: every box is the same work; a tenth for caches"},
  };
  return *growths;
}

std::string TimingReport(const TimingRun& run) {
  std::string text = absl::StrFormat(
      "Measured %s on %s; emmy %s. Medians over the repetitions of the "
      "processor time of a step, for batches of one step of one body; "
      "`batch_clock`, `net/large` and `chain/long`, whose threads share a "
      "step, are by the clock. The spread is the largest less the smallest "
      "over the median. A run whose laws are not kept has no time; of a "
      "batch, errors are those of its worst body.\n\n",
      run.date, run.processor, run.program);
  absl::StrAppend(&text, "### Ratios\n\n", RatioTable(run, Ratios()),
                  "\n### Growth\n\n", GrowthRows(run), "\n### Times\n\n",
                  TimeRows(run));
  return text;
}

std::string CompareTimings(const TimingRun& before, const TimingRun& now) {
  std::string text;
  for (const Timing& timing : now.timings) {
    const Timing* old = before.Find(timing.name);
    if (old == nullptr || !timing.error.empty()) continue;
    const double ratio = timing.median / old->median;
    const double noise = std::max(0.05, timing.spread + old->spread);
    if (std::abs(ratio - 1.0) <= noise) continue;
    absl::StrAppendFormat(&text, "- `%s` %s: %s, was %s (x %.2f)\n",
                          timing.name, ratio > 1.0 ? "slower" : "faster",
                          TimeText(timing.median), TimeText(old->median),
                          ratio);
  }
  return text.empty() ? "No time changed by more than its spread.\n" : text;
}

}  // namespace emmy::verification
