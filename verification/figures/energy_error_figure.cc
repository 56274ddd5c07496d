#include "verification/figures/energy_error_figure.h"

#include <cmath>

#include "absl/strings/str_format.h"
#include "emmy/diagnostics/invariant_monitor.h"
#include "verification/runs/paper_box.h"
#include "verification/runs/run.h"

namespace emmy::verification {
namespace {

absl::StatusOr<std::vector<double>> LargestErrors(
    double penalty, const std::vector<double>& readings, const Scheme& scheme) {
  absl::StatusOr<Run> run =
      Run::Start(PaperBoxAncf(penalty), kPaperTimeStep, scheme);
  if (!run.ok()) return run.status();
  InvariantMonitor monitor(run->model(), run->state());
  std::vector<double> errors;
  for (const double reading : readings) {
    const absl::Status status = run->Advance(
        static_cast<int64_t>(reading) - run->state().step,
        [&monitor](const Run& advanced) { monitor.Observe(advanced.state()); });
    if (!status.ok()) return status;
    errors.push_back(monitor.energy().max_relative_error());
  }
  return errors;
}

}  // namespace

absl::StatusOr<EnergyErrorStudy> StudyEnergyError(int64_t num_steps,
                                                  const Scheme& scheme) {
  EnergyErrorStudy study;
  for (int i = 10;; ++i) {
    const double reading = std::round(std::pow(10.0, i / 10.0));
    if (reading > static_cast<double>(num_steps)) break;
    study.steps.push_back(reading);
  }
  for (const double penalty : {1e8, 1e10, 1e12}) {
    absl::StatusOr<std::vector<double>> errors =
        LargestErrors(penalty, study.steps, scheme);
    if (!errors.ok()) return errors.status();
    absl::StatusOr<std::vector<double>> naive =
        LargestErrors(penalty, study.steps, PlainArithmeticScheme);
    if (!naive.ok()) return naive.status();
    study.curves.push_back({.penalty = penalty,
                            .errors = *std::move(errors),
                            .naive_errors = *std::move(naive)});
  }
  return study;
}

Figure EnergyErrorFigure(const EnergyErrorStudy& study) {
  Figure figure{.name = "energy_error",
                .title = "Energy error over many steps",
                .columns = {{"steps", study.steps}},
                .script = R"(set lmargin 11
set rmargin 24
set xlabel 'Number of time steps'
set ylabel 'Largest relative energy error'
set xrange [10:*]
set yrange [1e-19:1e-11]
set ytics 100
set key at graph 1.02, 0.98 left top Left reverse samplen 2 spacing 1.15 \
  maxrows 8
array exponent[3] = ['⁸', '¹⁰', '¹²']
array colour[3] = [2, 3, 1]
unit = 1.11e-16
set label 1 'unit round-off' at graph 0.01, first unit * 0.4 \
  font ',13' textcolor rgb '#555555'
plot unit with lines lt 7 lw 1 dt 3 notitle, \
     NaN with lines lc rgb 'white' title 'plain arithmetic', \
     for [k = 3:1:-1] data using 1:(column(2 * k + 1)) with lines \
       lt colour[k] dt 2 title sprintf('α = 10%s Pa', exponent[k]), \
     NaN with lines lc rgb 'white' title 'Emmy', \
     for [k = 3:1:-1] data using 1:(column(2 * k)) with lines lt colour[k] \
       lw 2.5 title sprintf('α = 10%s Pa', exponent[k])
)",
                .width = 960,
                .height = 500,
                .powers_of_ten = true};
  for (const EnergyErrorCurve& curve : study.curves) {
    const std::string name = PenaltyLabel(curve.penalty);
    figure.columns.push_back({"error " + name, curve.errors});
    figure.columns.push_back(
        {"error in plain arithmetic " + name, curve.naive_errors});
  }
  return figure;
}

}  // namespace emmy::verification
