// Second order in the time step, against the exact motion.

#include <algorithm>
#include <cmath>

#include "absl/strings/str_format.h"
#include "emmy/base/larger.h"
#include "verification/claims/groups.h"
#include "verification/runs/fit.h"
#include "verification/runs/motion_error.h"
#include "verification/runs/paper_box.h"
#include "verification/runs/run.h"

namespace emmy::verification {
namespace {

// So stiff, and started relaxed, that what is left is the error of the step.
constexpr double kPenalty = 1e14;   // [Pa]
constexpr double kDuration = 10.0;  // [s]

const std::vector<double>& TimeSteps() {
  static const std::vector<double>* const steps =
      new std::vector<double>{0.02, 0.01, 0.005, 0.0025};
  return *steps;
}

ReadingTimes Times() {
  return {.interval = TimeSteps().front(), .duration = kDuration};
}

absl::StatusOr<ClaimResult> Orders(const ClaimSetting& setting,
                                   const ModelDescription& description,
                                   const std::string& name) {
  std::vector<double> omega;
  std::vector<double> attitude;
  for (const double time_step : TimeSteps()) {
    const absl::StatusOr<MotionError> error = CompareWithExact(
        description, {.time_step = time_step}, Times(), setting.scheme);
    if (!error.ok()) return error.status();
    omega.push_back(error->angular_velocity);
    attitude.push_back(error->attitude);
  }
  ClaimResult result;
  result.values = {{"angular velocity, fitted", FitPower(TimeSteps(), omega)},
                   {"attitude, fitted", FitPower(TimeSteps(), attitude)}};
  for (size_t i = 1; i < TimeSteps().size(); ++i) {
    const std::string pair =
        absl::StrFormat("dt = %g to %g s", TimeSteps()[i - 1], TimeSteps()[i]);
    result.values.push_back(
        {"angular velocity, " + pair, std::log2(omega[i - 1] / omega[i])});
    result.values.push_back(
        {"attitude, " + pair, std::log2(attitude[i - 1] / attitude[i])});
  }
  result.notes.push_back(absl::StrFormat(
      "errors at the smallest step, %g s: %.2g rad/s and %.2g rad",
      TimeSteps().back(), omega.back(), attitude.back()));
  result.figures.push_back(
      {.name = "order_" + name,
       .title = "Order in the time step, " + name + " body",
       .columns = {{"time step [s]", TimeSteps()},
                   {"angular velocity error [rad/s]", omega},
                   {"attitude error [rad]", attitude}},
       .script = R"(set logscale xy
set format y '10^{%T}'
set xtics (0.0025, 0.005, 0.01, 0.02)
set xrange [0.0022:0.023]
set xlabel 'Time step [s]'
set ylabel 'Largest error over 10 s'
set key top left
stats data using 2 every ::3::3 nooutput
second(x) = STATS_max * (x / 0.0025)**2 * 0.5
plot data using 1:3 with linespoints lt 4 title 'Attitude [rad]', \
     data using 1:2 with linespoints lt 1 title 'Angular velocity [rad/s]', \
     second(x) with lines lt 7 dt 2 lw 1.5 title 'Slope 2'
)"});
  return result;
}

// What the penalty leaves, seen as the difference of two penalties: in
// proportion to 1/alpha, so 10/9 of the difference at alpha and 10 alpha.
absl::StatusOr<ClaimResult> Floor(const ClaimSetting& setting) {
  const double time_step = TimeSteps().back();
  absl::StatusOr<Run> soft = Run::Start(PaperBoxAncf(kPenalty, Start::kRelaxed),
                                        time_step, setting.scheme);
  if (!soft.ok()) return soft.status();
  absl::StatusOr<Run> stiff =
      Run::Start(PaperBoxAncf(10.0 * kPenalty, Start::kRelaxed), time_step,
                 setting.scheme);
  if (!stiff.ok()) return stiff.status();
  double omega = 0.0;
  double attitude = 0.0;
  for (int64_t i = 0; i < std::llround(kDuration / time_step); ++i) {
    for (Run* run : {&*soft, &*stiff}) {
      const absl::Status status = run->Advance(1);
      if (!status.ok()) return status;
    }
    const BodyMotion a = soft->Motion();
    const BodyMotion b = stiff->Motion();
    omega = Larger(omega, (a.omega_locked - b.omega_locked)
                              .cwiseAbs()
                              .maxCoeff<Eigen::PropagateNaN>());
    attitude = Larger(attitude, AngleBetween(a.quaternion, b.quaternion));
  }
  const absl::StatusOr<MotionError> error =
      CompareWithExact(PaperBoxAncf(kPenalty, Start::kRelaxed),
                       {.time_step = time_step}, Times(), setting.scheme);
  if (!error.ok()) return error.status();
  constexpr double kWhole = 10.0 / 9.0;
  return ClaimResult{
      .values = {{"angular velocity", kWhole * omega / error->angular_velocity},
                 {"attitude", kWhole * attitude / error->attitude}},
      .figures = {},
      .notes = {}};
}

Claim OrderClaim(const std::string& name, ModelDescription description,
                 const std::string& equations) {
  return {.id = "order/" + name + "_body",
          .sentence = "The " + name +
                      " body converges to the exact motion with order two in "
                      "the time step, angular velocity and attitude.",
          .equations = equations,
          .reference = Reference::kExact,
          .metric =
              "p of max error over 10 s = C dt^p, dt = 0.02 ... 0.0025 "
              "s, fitted and for each halving",
          .unit = "-",
          .bound = {.lower = 1.97,
                    .upper = 2.03,
                    .derivation =
                        "p = 2 for a symmetric rule of mean velocities; the "
                        "next term, dt^4, is (omega dt)^2 = 4e-4 of the "
                        "error at the largest step, and maxima are read at "
                        "the same times for every step"},
          .measure = [name, description = std::move(description)](
                         const ClaimSetting& setting) {
            return Orders(setting, description, name);
          }};
}

}  // namespace

std::vector<Claim> OrderClaims() {
  std::vector<Claim> claims;
  claims.push_back(OrderClaim("ancf", PaperBoxAncf(kPenalty, Start::kRelaxed),
                              "(EM-1..3), (TOP-6..9)"));
  claims.push_back(OrderClaim("conventional", PaperBoxConventional(),
                              "(CRB-3..5), (TOP-6..9)"));
  claims.push_back(
      {.id = "order/penalty_floor",
       .sentence = "The order of the ANCF body is not blurred by its penalty: "
                   "at 1e14 Pa, relaxed, the penalty's part of the error is "
                   "negligible even at the smallest step.",
       .equations = "(ANCF-8)",
       .reference = Reference::kCrossFormulation,
       .metric = "error in proportion to 1/alpha / error against the exact "
                 "motion, dt = 0.0025 s",
       .unit = "-",
       .bound = {.upper = 1e-3,
                 .derivation =
                     "a part r of the smallest error shifts the order of the "
                     "last halving by r / ln 2, here at most 1.4e-3, a "
                     "twentieth of the tolerance of the order"},
       .measure = Floor});
  return claims;
}

}  // namespace emmy::verification
