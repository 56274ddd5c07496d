// The paper's figures, as data, plots and claims.

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "emmy/base/larger.h"
#include "emmy/diagnostics/invariants.h"
#include "verification/claims/groups.h"
#include "verification/figures/energy_error_figure.h"
#include "verification/runs/paper_box.h"
#include "verification/runs/run.h"

namespace emmy::verification {
namespace {

// --- Figures 5 and 8: angular velocity about z for several penalties. ------

constexpr int64_t kFigure5Steps = 10000;  // Of 1 ms.
constexpr size_t kFigure5Every = 20;

// ω_z of the start and of every step.
absl::StatusOr<std::vector<double>> AngularVelocityZ(
    const ModelDescription& description, const Scheme& scheme) {
  absl::StatusOr<Run> run = Run::Start(description, kPaperTimeStep, scheme);
  if (!run.ok()) return run.status();
  std::vector<double> omega = {run->Motion().omega_polar.z()};
  const absl::Status status =
      run->Advance(kFigure5Steps, [&omega](const Run& advanced) {
        omega.push_back(advanced.Motion().omega_polar.z());
      });
  if (!status.ok()) return status;
  return omega;
}

double LargestDifference(const std::vector<double>& a,
                         const std::vector<double>& b) {
  double largest = 0.0;
  for (size_t i = 0; i < a.size(); ++i) {
    largest = Larger(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

// Vibrations are faster than a line of a plot: the largest since the reading
// before.
std::vector<double> LargestByInterval(const std::vector<double>& a,
                                      const std::vector<double>& b) {
  std::vector<double> largest = {std::abs(a[0] - b[0])};
  for (size_t i = 1; i < a.size(); ++i) {
    if (i % kFigure5Every == 1) largest.push_back(0.0);
    largest.back() = Larger(largest.back(), std::abs(a[i] - b[i]));
  }
  return largest;
}

std::vector<double> EveryReading(const std::vector<double>& values) {
  std::vector<double> readings;
  for (size_t i = 0; i < values.size(); i += kFigure5Every) {
    readings.push_back(values[i]);
  }
  return readings;
}

constexpr char kFigure5Script[] = R"(set multiplot
set lmargin 11
set rmargin 3
set xrange [0:10]
set tmargin at screen 0.97
set bmargin at screen 0.53
set format x ''
set ylabel 'ω_z  [rad/s]'
set yrange [0.45:1.1]
set key top center horizontal samplen 2
plot data using 1:3 with lines lt 2 title 'α = 10⁴ Pa', \
     data using 1:4 with lines lt 3 title 'α = 10⁵ Pa', \
     data using 1:5 with lines lt 5 title 'α = 10⁶ Pa', \
     data using 1:2 with lines lt 7 dt 2 title 'conventional body'
set tmargin at screen 0.49
set bmargin at screen 0.11
set format x '%g'
set xlabel 'Time  [s]'
set ylabel 'Difference  [rad/s]'
set logscale y
set format y '10^{%T}'
set yrange [1e-8:10]
set key bottom center horizontal samplen 2
plot data using 1:($6 > 0 ? $6 : NaN) with lines lt 2 title '10⁴ Pa', \
     data using 1:($7 > 0 ? $7 : NaN) with lines lt 3 title '10⁵ Pa', \
     data using 1:($8 > 0 ? $8 : NaN) with lines lt 5 title '10⁶ Pa', \
     data using 1:($9 > 0 ? $9 : NaN) with lines lt 1 title '10⁸ Pa', \
     data using 1:($10 > 0 ? $10 : NaN) with lines lt 4 title '10¹⁰ Pa', \
     data using 1:($11 > 0 ? $11 : NaN) with lines lt 6 title '10¹² Pa'
unset multiplot
)";

// The paper shows the same of the box alone and of the box with the truss.
struct PaperModel {
  const char* name;
  ModelDescription (*ancf)(double penalty);
  ModelDescription (*conventional)();
};

ModelDescription BoxAlone(double penalty) { return PaperBoxAncf(penalty); }

constexpr PaperModel kBox = {"", BoxAlone, PaperBoxConventional};
constexpr PaperModel kTruss = {", with a truss", PaperTrussAncf,
                               PaperTrussConventional};

absl::StatusOr<ClaimResult> AngularVelocityFigure(const ClaimSetting& setting,
                                                  const PaperModel& model,
                                                  const std::string& name) {
  const absl::StatusOr<std::vector<double>> conventional =
      AngularVelocityZ(model.conventional(), setting.scheme);
  if (!conventional.ok()) return conventional.status();
  ClaimResult result;
  Figure figure{
      .name = name,
      .title = absl::StrCat("Angular velocity about z for several penalties",
                            model.name),
      .columns = {},
      .script = kFigure5Script,
      .width = 960,
      .height = 760};
  std::vector<double> time;
  for (size_t i = 0; i <= kFigure5Steps; i += kFigure5Every) {
    time.push_back(static_cast<double>(i) * kPaperTimeStep);
  }
  figure.columns = {
      {"time [s]", time},
      {"omega_z conventional [rad/s]", EveryReading(*conventional)}};
  std::vector<Column> differences;
  double previous = 0.0;
  for (const double penalty : {1e4, 1e5, 1e6, 1e8, 1e10, 1e12}) {
    const absl::StatusOr<std::vector<double>> omega =
        AngularVelocityZ(model.ancf(penalty), setting.scheme);
    if (!omega.ok()) return omega.status();
    const std::string label = PenaltyLabel(penalty);
    if (penalty <= 1e6) {
      figure.columns.push_back(
          {"omega_z " + label + " [rad/s]", EveryReading(*omega)});
    }
    differences.push_back({"largest difference at " + label + " [rad/s]",
                           LargestByInterval(*omega, *conventional)});
    const double difference = LargestDifference(*omega, *conventional);
    if (previous != 0.0) {
      result.values.push_back({"up to " + label, difference / previous});
    }
    result.notes.push_back(
        absl::StrFormat("%s: %.3g rad/s", label, difference));
    previous = difference;
  }
  figure.columns.insert(figure.columns.end(), differences.begin(),
                        differences.end());
  result.figures.push_back(std::move(figure));
  return result;
}

// --- Figures 6 and 9: internal energy for several time steps. --------------

constexpr double kFigure6Penalty = 1e8;  // [Pa]

struct EnergyHistory {
  std::vector<double> internal;        // [kJ]
  std::vector<double> kinetic;         // [kJ]
  std::vector<double> relative_error;  // Of the internal energy.
  double largest_error = 0.0;
};

// Read at the times that all steps share.
absl::StatusOr<EnergyHistory> InternalEnergy(const PaperModel& model,
                                             double time_step, double reading,
                                             const Scheme& scheme) {
  absl::StatusOr<Run> run =
      Run::Start(model.ancf(kFigure6Penalty), time_step, scheme);
  if (!run.ok()) return run.status();
  const DoubleDouble start =
      MeasureInvariants(run->model(), run->state()).InternalEnergy();
  EnergyHistory history;
  const auto observe = [&](const Run& advanced) {
    const Invariants now =
        MeasureInvariants(advanced.model(), advanced.state());
    const DoubleDouble internal = now.InternalEnergy();
    const double error = (internal - start).ToDouble() / start.ToDouble();
    history.largest_error = Larger(history.largest_error, std::abs(error));
    const auto every = std::llround(reading / time_step);
    if (advanced.state().step % every != 0) return;
    history.internal.push_back(1e-3 * internal.ToDouble());
    history.kinetic.push_back(1e-3 * now.kinetic_energy.ToDouble());
    history.relative_error.push_back(error);
  };
  observe(*run);
  const absl::Status status =
      run->Advance(std::llround(kPaperDuration / time_step), observe);
  if (!status.ok()) return status;
  return history;
}

constexpr char kFigure6Script[] = R"(set multiplot
set lmargin 11
set rmargin 3
set xrange [0:10]
set tmargin at screen 0.97
set bmargin at screen 0.55
set format x ''
set format y '%.1f'
set ylabel 'Internal energy  [kJ]'
set yrange [0:9]
set key bottom right Left reverse samplen 3
plot data using 1:2 with lines lt 5 lw 9 title 'Δt = 1 ms', \
     data using 1:5 with lines lt 2 lw 5 title 'Δt = 10 ms', \
     data using 1:8 with lines lt 7 lw 1.5 title 'Δt = 100 ms'
set tmargin at screen 0.50
set bmargin at screen 0.11
set format x '%g'
set format y '%g'
set xlabel 'Time  [s]'
set ylabel 'Relative error  [10^{-16}]'
set autoscale y
set key top left Left reverse samplen 2
plot data using 1:($4*1e16) with linespoints lt 5 pt 7 ps 0.4 \
       title 'Δt = 1 ms', \
     data using 1:($7*1e16) with linespoints lt 2 pt 5 ps 0.4 \
       title 'Δt = 10 ms', \
     data using 1:($10*1e16) with linespoints lt 7 pt 6 ps 0.4 \
       title 'Δt = 100 ms'
unset multiplot
)";

absl::StatusOr<ClaimResult> InternalEnergyFigure(
    const ClaimSetting& setting, const PaperModel& model,
    const std::string& figure_name) {
  constexpr double kReading = 0.1;  // [s]
  ClaimResult result;
  Figure figure{.name = figure_name,
                .title = absl::StrCat("Internal energy for several time steps",
                                      model.name),
                .columns = {{"time [s]", {}}},
                .script = kFigure6Script,
                .width = 960,
                .height = 760};
  for (int i = 0; i <= std::lround(kPaperDuration / kReading); ++i) {
    figure.columns[0].values.push_back(i * kReading);
  }
  for (const double time_step : {1e-3, 1e-2, 1e-1}) {
    const absl::StatusOr<EnergyHistory> history =
        InternalEnergy(model, time_step, kReading, setting.scheme);
    if (!history.ok()) return history.status();
    const std::string name = absl::StrFormat("dt = %g s", time_step);
    figure.columns.push_back(
        {"internal energy " + name + " [kJ]", history->internal});
    figure.columns.push_back(
        {"kinetic energy " + name + " [kJ]", history->kinetic});
    figure.columns.push_back(
        {"relative error " + name, history->relative_error});
    result.values.push_back({name, history->largest_error});
  }
  result.figures.push_back(std::move(figure));
  return result;
}

// --- The energy error over many steps, beside a naive variant. -------------

absl::StatusOr<ClaimResult> EnergyError(const ClaimSetting& setting) {
  const absl::StatusOr<EnergyErrorStudy> study =
      StudyEnergyError(IsFull(setting) ? 1000000 : 20000, setting.scheme);
  if (!study.ok()) return study.status();
  ClaimResult result;
  for (const EnergyErrorCurve& curve : study->curves) {
    result.values.push_back({PenaltyLabel(curve.penalty),
                             curve.errors.back() / curve.naive_errors.back()});
  }
  result.figures.push_back(EnergyErrorFigure(*study));
  return result;
}

}  // namespace

std::vector<Claim> FigureClaims() {
  std::vector<Claim> claims;
  claims.push_back(
      {.id = "figures/paper_5",
       .sentence = "The angular velocity about z approaches the conventional "
                   "body's as the penalty grows (the paper's figure 5).",
       .equations = "(ATT-2); paper, figure 5",
       .reference = Reference::kPublished,
       .metric = "max |difference| over 10 s / that of the next softer "
                 "penalty, alpha = 1e4, 1e5, 1e6, 1e8, 1e10, 1e12 Pa",
       .unit = "-",
       .bound = {.upper = 0.5,
                 .derivation =
                     "published is that it converges; alpha^(-1/2) makes it "
                     "0.32 for one decade, 0.1 for two"},
       .measure = [](const ClaimSetting& setting) {
         return AngularVelocityFigure(setting, kBox, "paper_figure_5");
       }});
  claims.push_back(
      {.id = "figures/paper_6",
       .sentence = "The internal energy, kinetic and penalty, is constant for "
                   "every time step (the paper's figure 6).",
       .equations = "(EM-2), (EM-3); paper, figure 6",
       .reference = Reference::kPublished,
       .metric = "largest |E - E0| / E over 10 s, every step",
       .unit = "-",
       .bound = {.upper = 1e-14,
                 .derivation =
                     "published is that it is exactly conserved: round-off "
                     "of 100 steps of 0.1 s, a tenth of what is claimed for "
                     "10^5 of them"},
       .measure = [](const ClaimSetting& setting) {
         return InternalEnergyFigure(setting, kBox, "paper_figure_6");
       }});
  claims.push_back(
      {.id = "figures/paper_8",
       .sentence = "With a truss on one corner, the angular velocity about z "
                   "approaches the conventional body's as the penalty grows "
                   "(the paper's figure 8).",
       .equations = "(ATT-2), (LINE-3), (CRB-6..8); paper, figure 8",
       .reference = Reference::kPublished,
       .metric = "max |difference| over 10 s / that of the next softer "
                 "penalty, alpha = 1e4, 1e5, 1e6, 1e8, 1e10, 1e12 Pa",
       .unit = "-",
       .bound = {.upper = 0.5,
                 .derivation =
                     "published is that it converges; alpha^(-1/2) makes it "
                     "0.32 for one decade, 0.1 for two"},
       .measure = [](const ClaimSetting& setting) {
         return AngularVelocityFigure(setting, kTruss, "paper_figure_8");
       }});
  claims.push_back(
      {.id = "figures/paper_9",
       .sentence = "With a truss on one corner, the internal energy, kinetic, "
                   "penalty and elastic, is constant for every time step (the "
                   "paper's figure 9).",
       .equations = "(EM-2), (EM-3), (LINE-2); paper, figure 9",
       .reference = Reference::kPublished,
       .metric = "largest |E - E0| / E over 10 s, every step",
       .unit = "-",
       .bound = {.upper = 1e-14,
                 .derivation =
                     "published is that it is exactly conserved: round-off "
                     "of 100 steps of 0.1 s, a tenth of what is claimed for "
                     "10^5 of them"},
       .measure = [](const ClaimSetting& setting) {
         return InternalEnergyFigure(setting, kTruss, "paper_figure_9");
       }});
  claims.push_back(
      {.id = "figures/energy_error",
       .sentence = "Carried strain and compensated sums are what keeps the "
                   "energy: the same step in plain floating point loses "
                   "digits.",
       .equations = "(QS-1), (EM-3)",
       .reference = Reference::kCrossFormulation,
       .metric = "largest energy error / that in plain arithmetic, alpha = "
                 "1e8, 1e10, 1e12 Pa",
       .unit = "-",
       .bound = {.upper = 0.1,
                 .derivation =
                     "one decimal digit at least. A recomputed strain is wrong "
                     "by u and its energy by b e u, e = M omega^2 / b, each "
                     "step; a carried one by omega dt = 1e-3 of that; the rest "
                     "is what chance may do to two random walks"},
       .measure = EnergyError});
  return claims;
}

}  // namespace emmy::verification
