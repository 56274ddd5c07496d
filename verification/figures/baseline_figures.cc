#include "verification/figures/baseline_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "absl/strings/str_format.h"
#include "emmy/diagnostics/invariants.h"
#include "verification/runs/run.h"

namespace emmy::verification {
namespace {

constexpr double kLost = 1e200;  // Beyond, squares overflow.

// Also of vectors whose squares overflow.
double Length(const DoubleDouble3& v) {
  return std::hypot(v[0].ToDouble(), v[1].ToDouble(), v[2].ToDouble());
}

}  // namespace

std::vector<Method> ComparedMethods(const Scheme& scheme,
                                    const BaselineSource& baseline) {
  std::vector<Method> methods = {{"energy-momentum", scheme}};
  for (const Baseline each : AllBaselines()) {
    methods.push_back({BaselineName(each), baseline(each)});
  }
  return methods;
}

absl::StatusOr<ConservationHistory> FollowRun(
    const ModelDescription& description, double time_step, double duration,
    const std::vector<double>& readings, const Scheme& scheme) {
  absl::StatusOr<Run> run = Run::Start(description, time_step, scheme);
  if (!run.ok()) return run.status();
  const Invariants start = MeasureInvariants(run->model(), run->state());
  const double energy = start.TotalEnergy().ToDouble();
  const double momentum = Length(start.angular_momentum);
  ConservationHistory history;
  history.time_of_loss = duration;
  size_t reading = 0;
  const int64_t steps = std::llround(duration / time_step);
  bool goes_on = true;
  for (int64_t i = 1; i <= steps && goes_on; ++i) {
    const double time = static_cast<double>(i) * time_step;
    const StepReport report = run->Step();
    double error = kLost;
    if (report.ok()) {
      const Invariants now = MeasureInvariants(run->model(), run->state());
      error = std::abs((now.TotalEnergy() - start.TotalEnergy()).ToDouble()) /
              energy;
      history.largest_angular_momentum = std::max(
          history.largest_angular_momentum,
          Length(now.angular_momentum - start.angular_momentum) / momentum);
    }
    goes_on = error < kLost;  // NaN does not.
    if (goes_on) {
      history.largest_energy = std::max(history.largest_energy, error);
    } else if (report.termination != Termination::kMaxIterations) {
      history.largest_energy = kLost;
    }
    if (!goes_on || error > 0.5) {
      history.time_of_loss = std::min(history.time_of_loss, time);
    }
    for (; goes_on && reading < readings.size() &&
           time >= readings[reading] * (1.0 - 1e-9);
         ++reading) {
      history.energy.push_back(history.largest_energy);
    }
  }
  history.energy.resize(readings.size(),
                        history.largest_energy < kLost
                            ? std::numeric_limits<double>::quiet_NaN()
                            : kLost);
  return history;
}

namespace {

absl::StatusOr<BaselinePanel> RunPanel(PenaltyModel model, double penalty,
                                       double time_step, double duration,
                                       const std::vector<double>& readings,
                                       const std::vector<Method>& methods) {
  BaselinePanel panel{
      .penalty = penalty, .time_step = time_step, .methods = {}};
  for (const Method& method : methods) {
    absl::StatusOr<ConservationHistory> history =
        FollowRun(model(penalty), time_step, duration, readings, method.scheme);
    if (!history.ok()) return history.status();
    panel.methods.push_back(*std::move(history));
  }
  return panel;
}

void NameMethods(const std::vector<Method>& methods, BaselineStudy* study) {
  for (const Method& method : methods) study->names.push_back(method.name);
}

constexpr char kHistoryScript[] = R"(set multiplot
set logscale xy
set xrange [0.1:*]
set yrange [1e-19:1e4]
set ytics 1e4
set mytics 1
set format x '%g'
set key off
unit = 1.11e-16
left(k) = 0.083 + 0.309 * k
array heading[3] = ['α = 10⁸ Pa, Δt = 1 ms', 'α = 10¹² Pa, Δt = 10 ms', \
  'α = 10¹⁰ Pa, Δt = 100 ms']
array method[5] = ['energy-momentum', 'Newmark', 'midpoint', \
  'generalised α', 'Verlet']
array colour[5] = [1, 2, 3, 6, 4]
array dash[5] = [1, 1, 1, 2, 1]
array place[5] = [0.14, 0.34, 0.46, 0.58, 0.76]
do for [m = 1:5] {
  set arrow 10 + m from screen place[m], 0.95 to screen place[m] + 0.04, 0.95 \
    nohead lt colour[m] lw (m == 1 ? 3 : 2) dt dash[m]
  set label 10 + m method[m] at screen place[m] + 0.048, 0.95
}
set tmargin at screen 0.82
set bmargin at screen 0.14
do for [k = 0:2] {
  set lmargin at screen left(k)
  set rmargin at screen left(k) + 0.273
  set label 1 heading[k + 1] at graph 0.5, 1.05 center
  if (k == 0) { set ylabel 'Largest relative energy error' offset 1.5,0
    set format y '10^{%T}'
    set label 2 'unit round-off' at graph 0.03, first unit * 8 font ',13' \
      textcolor rgb '#555555' } else {
    unset ylabel; set format y ''; unset label 2 }
  if (k == 1) { set xlabel 'Time  [s]' } else { set xlabel ' ' }
  plot unit with lines lt 7 lw 1 dt 3 notitle, \
       for [m = 1:5] data using 1:(c = column(1 + 5 * k + m), \
         c > 0 ? (c < 1e3 ? c : 1e3) : NaN) with lines \
         lt colour[m] lw (m == 1 ? 3 : 2) dt dash[m] notitle
}
unset multiplot
)";

constexpr char kMapScript[] = R"(set multiplot
set logscale xy
set logscale cb
set xrange [10**-3.25:10**-0.75]
set cbrange [1e-17:1]
set palette defined (0 '#08306b', 2 '#2171b5', 4 '#6baed6', 8 '#fee391', \
  12 '#fe9929', 15 '#cc4c02', 17 '#4d0f00')
set format cb '10^{%T}'
set cbtics 1e4
set format x '10^{%T}'
set xtics 10
set ytics 100
set mytics 1
set mxtics 1
set mcbtics 1
set tics scale 0.5
unset grid
set key off
half = 10**0.24
stats data using 2 nooutput
tall = 10**(log10(STATS_max / STATS_min) / \
  (STATS_records / 5 - 1) / 2.0 * 0.96)
set yrange [STATS_min / tall / 1.1:STATS_max * tall * 1.1]
array method[5] = ['energy-momentum', 'Newmark', 'midpoint', \
  'generalised α', 'Verlet']
set tmargin at screen 0.88
set bmargin at screen 0.22
do for [m = 1:5] {
  set lmargin at screen 0.075 + 0.162 * (m - 1)
  set rmargin at screen 0.075 + 0.162 * (m - 1) + 0.152
  set label 1 method[m] at graph 0.5, 1.06 center
  if (m == 1) { set ylabel 'Penalty α  [Pa]' offset 0.5,0
    set format y '10^{%T}' } else { unset ylabel; set format y '' }
  if (m == 3) { set xlabel 'Time step  [s]' } else { set xlabel ' ' }
  if (m == 5) { set colorbox user origin 0.90,0.22 size 0.018,0.66
    set cblabel 'Largest relative energy error' offset 1,0 } else {
    unset colorbox; unset cblabel }
  plot data using 1:2:($1 / half):($1 * half):($2 / tall):($2 * tall):\
    (c = column(2 + m), c > 1e-17 ? (c < 1 ? c : 1) : 1e-17) \
    with boxxyerror fillstyle solid noborder lc palette
}
unset multiplot
)";

}  // namespace

absl::StatusOr<BaselineStudy> StudyBaselines(
    PenaltyModel model, double duration, const std::vector<Method>& methods) {
  BaselineStudy study;
  study.duration = duration;
  NameMethods(methods, &study);
  for (int i = -20; std::pow(10.0, 0.05 * i) <= duration; ++i) {
    study.readings.push_back(std::pow(10.0, 0.05 * i));
  }
  struct Setting {
    double penalty;
    double time_step;
  };
  for (const auto [penalty, time_step] :
       {Setting{1e8, 1e-3}, Setting{1e12, 1e-2}, Setting{1e10, 1e-1}}) {
    absl::StatusOr<BaselinePanel> panel =
        RunPanel(model, penalty, time_step, duration, study.readings, methods);
    if (!panel.ok()) return panel.status();
    study.panels.push_back(*std::move(panel));
  }
  return study;
}

Figure BaselineHistoryFigure(const BaselineStudy& study,
                             const std::string& name,
                             const std::string& title) {
  Figure figure{.name = name,
                .title = title,
                .columns = {{"time [s]", study.readings}},
                .script = kHistoryScript,
                .width = 1080,
                .height = 480};
  for (const BaselinePanel& panel : study.panels) {
    for (size_t m = 0; m < study.names.size(); ++m) {
      figure.columns.push_back(
          {absl::StrFormat("%s alpha = %g Pa dt = %g s", study.names[m],
                           panel.penalty, panel.time_step),
           panel.methods[m].energy});
    }
  }
  return figure;
}

absl::StatusOr<BaselineStudy> MapBaselines(PenaltyModel model, double duration,
                                           const std::vector<double>& penalties,
                                           const std::vector<Method>& methods) {
  BaselineStudy study;
  study.duration = duration;
  NameMethods(methods, &study);
  for (const double penalty : penalties) {
    for (int i = -6; i <= -2; ++i) {
      absl::StatusOr<BaselinePanel> panel = RunPanel(
          model, penalty, std::pow(10.0, 0.5 * i), duration, {}, methods);
      if (!panel.ok()) return panel.status();
      study.panels.push_back(*std::move(panel));
    }
  }
  return study;
}

Figure BaselineMapFigure(const BaselineStudy& study, const std::string& name,
                         const std::string& title) {
  Figure figure{.name = name,
                .title = title,
                .columns = {{"time step [s]", {}}, {"penalty [Pa]", {}}},
                .script = kMapScript,
                .width = 1080,
                .height = 380};
  for (const std::string& method : study.names) {
    figure.columns.push_back({method, {}});
  }
  for (const BaselinePanel& panel : study.panels) {
    figure.columns[0].values.push_back(panel.time_step);
    figure.columns[1].values.push_back(panel.penalty);
    for (size_t m = 0; m < study.names.size(); ++m) {
      const ConservationHistory& history = panel.methods[m];
      const bool lost = history.time_of_loss < study.duration;
      figure.columns[2 + m].values.push_back(
          lost ? std::max(1.0, history.largest_energy)
               : history.largest_energy);
    }
  }
  return figure;
}

}  // namespace emmy::verification
