// Orders four and six, composed of energy-momentum steps.

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "verification/claims/groups.h"
#include "verification/runs/fit.h"
#include "verification/runs/motion_error.h"
#include "verification/runs/paper_box.h"
#include "verification/runs/run.h"

namespace emmy::verification {
namespace {

// So stiff that its part of the error, in proportion to 1/alpha, is below the
// error of the smallest step; see composition/floors.
constexpr double kStiffPenalty = 1e17;  // [Pa]
// So soft that a step of 0.02 s resolves its vibration of 7 rad/s.
constexpr double kSoftPenalty = 1e4;
// The vibration, of up to 2.4e3 rad/s, is neither resolved nor passed by far.
constexpr double kBetweenPenalty = 1e9;

constexpr ReadingTimes kTenSeconds = {.interval = 0.2, .duration = 10.0};
constexpr ReadingTimes kTwoSeconds = {.interval = 0.05, .duration = 2.0};

// Halvings of `first`.
std::vector<double> Halvings(double first, int count) {
  std::vector<double> steps(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i) {
    steps[static_cast<size_t>(i)] = std::ldexp(first, -i);
  }
  return steps;
}

// Against the exact motion; the sixth order reaches round-off after 0.05 s.
std::vector<double> ExactSteps(int order) {
  return Halvings(0.2, order == 6 ? 3 : 4);
}
std::vector<double> SoftSteps(int order) {
  return order == 6 ? Halvings(0.05, 3) : Halvings(0.025, 4);
}

struct Study {
  std::vector<double> steps;
  std::vector<double> omega;
  std::vector<double> attitude;
};

absl::StatusOr<Study> StudyOrder(const ClaimSetting& setting, int order,
                                 const ModelDescription& description,
                                 const std::vector<double>& steps,
                                 const ReadingTimes& times,
                                 const std::vector<BodyMotion>& truth) {
  Study study{.steps = steps, .omega = {}, .attitude = {}};
  for (const double time_step : steps) {
    const absl::StatusOr<std::vector<BodyMotion>> motion =
        ReadMotion(description, {.order = order, .time_step = time_step}, times,
                   setting.scheme);
    if (!motion.ok()) return motion.status();
    const MotionError error = LargestError(*motion, truth);
    study.omega.push_back(error.angular_velocity);
    study.attitude.push_back(error.attitude);
  }
  return study;
}

ClaimResult JudgeOrder(const Study& study) {
  ClaimResult result;
  result.values = {
      {"angular velocity, fitted", FitPower(study.steps, study.omega)},
      {"attitude, fitted", FitPower(study.steps, study.attitude)}};
  for (size_t i = 1; i < study.steps.size(); ++i) {
    const std::string pair =
        absl::StrFormat("dt = %g to %g s", study.steps[i - 1], study.steps[i]);
    result.values.push_back({"angular velocity, " + pair,
                             std::log2(study.omega[i - 1] / study.omega[i])});
    result.values.push_back(
        {"attitude, " + pair,
         std::log2(study.attitude[i - 1] / study.attitude[i])});
  }
  result.notes.push_back(absl::StrFormat(
      "errors at the smallest step, %g s: %.2g rad/s and %.2g rad",
      study.steps.back(), study.omega.back(), study.attitude.back()));
  return result;
}

Figure OrderFigure(const std::string& name, int order, const Study& study) {
  return {.name = absl::StrFormat("composition_%s_%d", name, order),
          .title = absl::StrFormat("Order %d in the time step, %s body", order,
                                   name),
          .columns = {{"time step [s]", study.steps},
                      {"angular velocity error [rad/s]", study.omega},
                      {"attitude error [rad]", study.attitude}},
          .script = absl::StrFormat(R"(set logscale xy
set format y '10^{%%T}'
set xlabel 'Time step [s]'
set ylabel 'Largest error'
set key top left
stats data using 1 name 'H' nooutput
stats data using 3 every ::0::0 name 'E' nooutput
set xrange [0.9 * H_min:1.1 * H_max]
slope(x) = 2 * E_max * (x / H_max)**%d
plot data using 1:3 with linespoints lt 4 title 'Attitude [rad]', \
     data using 1:2 with linespoints lt 1 title 'Angular velocity [rad/s]', \
     slope(x) with lines lt 7 dt 2 lw 1.5 title 'Slope %d'
)",
                                    order, order)};
}

absl::StatusOr<ClaimResult> OrderAgainstExact(
    const ClaimSetting& setting, int order, const std::string& name,
    const ModelDescription& description) {
  const absl::StatusOr<std::vector<BodyMotion>> truth =
      ExactMotion(kTenSeconds);
  if (!truth.ok()) return truth.status();
  const absl::StatusOr<Study> study = StudyOrder(
      setting, order, description, ExactSteps(order), kTenSeconds, *truth);
  if (!study.ok()) return study.status();
  ClaimResult result = JudgeOrder(*study);
  result.figures.push_back(OrderFigure(name, order, *study));
  return result;
}

// The library's own scheme, whatever is tested: a wrong variant would be wrong
// in the same way.
absl::StatusOr<std::vector<BodyMotion>> FineMotion(
    const ModelDescription& description, double time_step,
    const ReadingTimes& times) {
  return ReadMotion(description, {.order = 6, .time_step = time_step}, times,
                    EnergyMomentumScheme);
}

absl::StatusOr<ClaimResult> OrderOfSoftBody(const ClaimSetting& setting,
                                            int order) {
  const ModelDescription description = PaperBoxAncf(kSoftPenalty);
  const std::vector<double> steps = SoftSteps(order);
  // The error of order six is below rounding there.
  const absl::StatusOr<std::vector<BodyMotion>> truth =
      FineMotion(description, steps.front() / 16.0, kTwoSeconds);
  if (!truth.ok()) return truth.status();
  const absl::StatusOr<Study> study =
      StudyOrder(setting, order, description, steps, kTwoSeconds, *truth);
  if (!study.ok()) return study.status();
  ClaimResult result = JudgeOrder(*study);
  result.figures.push_back(OrderFigure("soft", order, *study));
  return result;
}

// What rounding and the penalty leave, over the smallest error that an order
// is fitted to. Rounding: the sixth order at an eighth of that step, where its
// own error is 8^-6 of it. Penalty: 10/9 of the difference of two penalties.
absl::StatusOr<ClaimResult> Floors(const ClaimSetting& setting) {
  const absl::StatusOr<std::vector<BodyMotion>> truth =
      ExactMotion(kTenSeconds);
  if (!truth.ok()) return truth.status();
  const absl::StatusOr<MotionError> rounding = CompareWithExact(
      PaperBoxConventional(), {.order = 6, .time_step = 0.00625}, kTenSeconds,
      setting.scheme);
  if (!rounding.ok()) return rounding.status();
  ClaimResult result;
  const auto add = [&result](const std::string& label, const MotionError& part,
                             const MotionError& whole) {
    result.values.push_back({absl::StrCat(label, ", angular velocity"),
                             part.angular_velocity / whole.angular_velocity});
    result.values.push_back(
        {absl::StrCat(label, ", attitude"), part.attitude / whole.attitude});
  };
  for (const int order : {4, 6}) {
    const IntegratorOptions options{.order = order,
                                    .time_step = ExactSteps(order).back()};
    const absl::StatusOr<MotionError> conventional = CompareWithExact(
        PaperBoxConventional(), options, kTenSeconds, setting.scheme);
    if (!conventional.ok()) return conventional.status();
    add(absl::StrCat("order ", order, ", rounding"), *rounding, *conventional);
    const absl::StatusOr<std::vector<BodyMotion>> stiff =
        ReadMotion(PaperBoxAncf(kStiffPenalty, Start::kRelaxed), options,
                   kTenSeconds, setting.scheme);
    if (!stiff.ok()) return stiff.status();
    const absl::StatusOr<std::vector<BodyMotion>> softer =
        ReadMotion(PaperBoxAncf(0.1 * kStiffPenalty, Start::kRelaxed), options,
                   kTenSeconds, setting.scheme);
    if (!softer.ok()) return softer.status();
    MotionError penalty = LargestError(*stiff, *softer);
    // C/alpha of the difference C (10 - 1)/alpha.
    penalty.angular_velocity /= 9.0;
    penalty.attitude /= 9.0;
    add(absl::StrCat("order ", order, ", penalty"), penalty,
        LargestError(*stiff, *truth));
  }
  return result;
}

// Where the vibration is neither resolved nor passed by far.
absl::StatusOr<ClaimResult> Between(const ClaimSetting& setting) {
  constexpr ReadingTimes kTimes = {.interval = 0.1, .duration = 2.0};
  const ModelDescription description =
      PaperBoxAncf(kBetweenPenalty, Start::kRelaxed);
  const absl::StatusOr<std::vector<BodyMotion>> fine =
      FineMotion(description, 0.1 / 128.0, kTimes);
  if (!fine.ok()) return fine.status();
  const absl::StatusOr<std::vector<BodyMotion>> rigid = ExactMotion(kTimes);
  if (!rigid.ok()) return rigid.status();
  const MotionError penalty = LargestError(*fine, *rigid);
  ClaimResult result;
  for (const int order : {4, 6}) {
    const absl::StatusOr<Study> study = StudyOrder(
        setting, order, description, Halvings(0.1, 6), kTimes, *fine);
    if (!study.ok()) return study.status();
    std::string note =
        absl::StrFormat("order %d, dt = 0.1 s and halves:", order);
    for (size_t i = 0; i < study->steps.size(); ++i) {
      result.values.push_back(
          {absl::StrFormat("order %d, dt = %g s, angular velocity", order,
                           study->steps[i]),
           study->omega[i] / penalty.angular_velocity});
      result.values.push_back({absl::StrFormat("order %d, dt = %g s, attitude",
                                               order, study->steps[i]),
                               study->attitude[i] / penalty.attitude});
      absl::StrAppendFormat(&note, " %.2g", study->omega[i]);
    }
    result.notes.push_back(note + " rad/s");
  }
  result.notes.push_back(
      absl::StrFormat("the penalty's part: %.2g rad/s, %.2g rad",
                      penalty.angular_velocity, penalty.attitude));
  return result;
}

absl::StatusOr<ClaimResult> Conservation(const ClaimSetting& setting) {
  struct Case {
    std::string name;
    ModelDescription model;
    double time_step;
    int64_t quick_steps;
    int64_t full_steps;
  };
  const std::vector<Case> cases = {
      {"ancf, 1e6 Pa", PaperBoxAncf(1e6), 1e-2, 5000, 50000},
      {"ancf, 1e10 Pa", PaperBoxAncf(1e10), 1e-2, 5000, 50000},
      {"ancf, 1e14 Pa", PaperBoxAncf(1e14), 1e-2, 5000, 50000},
      {"conventional", PaperBoxConventional(), 1e-2, 5000, 50000},
      {"with a truss", PaperTrussAncf(1e10), 1e-3, 300, 10000}};
  ClaimResult result;
  for (const Case& each : cases) {
    for (const int order : {4, 6}) {
      const absl::StatusOr<ConservationErrors> errors = MeasureConservation(
          each.model, {.order = order, .time_step = each.time_step},
          IsFull(setting) ? each.full_steps : each.quick_steps, setting.scheme);
      if (!errors.ok()) return errors.status();
      const std::string label =
          absl::StrFormat("%s, order %d", each.name, order);
      result.values.push_back(
          {absl::StrCat(label, ", energy"), errors->energy});
      result.values.push_back({absl::StrCat(label, ", angular momentum"),
                               errors->angular_momentum});
    }
  }
  return result;
}

// How near the order must be: see the claims' derivations.
constexpr double kTolerance = 0.1;

Bound OrderBound(int order, const std::string& derivation) {
  return {.lower = order - kTolerance,
          .upper = order + kTolerance,
          .derivation = derivation};
}

void AddOrderClaims(int order, std::vector<Claim>* claims) {
  const std::string word = order == 4 ? "four" : "six";
  const std::string exact_metric = absl::StrFormat(
      "p of max error over 10 s = C dt^p, dt = 0.2 ... %g s, fitted and for "
      "each halving",
      ExactSteps(order).back());
  const std::string next_term =
      "p is the order; the next term is c (omega dt)^2 of the error, at most "
      "0.04 c for the largest step, and shifts the order of its halving by "
      "0.04 c 3/4 / ln 2 = 0.04 c, c of the order of one";
  const std::string rounding =
      "; a floor r <= 0.05 of the smallest error (composition/floors) shifts "
      "the last halving by r / ln 2 = 0.07";
  claims->push_back(
      {.id = absl::StrCat("composition/conventional_order_", order),
       .sentence = absl::StrCat("Composed of steps back and forth, the "
                                "conventional body's motion has order ",
                                word, "."),
       .equations = "(COMP-1..4), (CRB-3..5), (TOP-6..9)",
       .reference = Reference::kExact,
       .metric = exact_metric,
       .unit = "-",
       .bound = OrderBound(order, absl::StrCat(next_term, rounding)),
       .measure = [order](const ClaimSetting& setting) {
         return OrderAgainstExact(setting, order, "conventional",
                                  PaperBoxConventional());
       }});
  claims->push_back(
      {.id = absl::StrCat("composition/ancf_order_", order),
       .sentence = absl::StrCat("Composed likewise, the relaxed ANCF body's "
                                "motion at 1e17 Pa, whose penalty no step "
                                "resolves, has order ",
                                word, "."),
       .equations = "(COMP-1..4), (ANCF-8), (TOP-6..9)",
       .reference = Reference::kExact,
       .metric = exact_metric,
       .unit = "-",
       .bound = OrderBound(order, absl::StrCat(next_term, rounding)),
       .measure = [order](const ClaimSetting& setting) {
         return OrderAgainstExact(setting, order, "ancf",
                                  PaperBoxAncf(kStiffPenalty, Start::kRelaxed));
       }});
  claims->push_back(
      {.id = absl::StrCat("composition/soft_order_", order),
       .sentence = absl::StrCat("Composed likewise, the motion of an ANCF body "
                                "of 1e4 Pa, whose vibration is resolved, has "
                                "order ",
                                word, "."),
       .equations = "(COMP-1..4), (ANCF-5)",
       .reference = Reference::kCrossFormulation,
       .metric = absl::StrFormat(
           "p of max error over 2 s = C dt^p, dt = %g ... %g s; compared with "
           "order six at a sixteenth of the first",
           SoftSteps(order).front(), SoftSteps(order).back()),
       .unit = "-",
       .bound = OrderBound(order,
                           "p is the order; the next term is c (omega dt)^2, "
                           "omega = 7 rad/s of the vibration and dt the "
                           "largest part of a step, 0.4 of it: 0.02 c, and as "
                           "much of order, c of the order of one"),
       .measure = [order](const ClaimSetting& setting) {
         return OrderOfSoftBody(setting, order);
       }});
}

}  // namespace

std::vector<Claim> CompositionClaims() {
  std::vector<Claim> claims;
  for (const int order : {4, 6}) AddOrderClaims(order, &claims);
  claims.push_back(
      {.id = "composition/floors",
       .sentence = "These orders are not blurred: rounding and the penalty at "
                   "1e17 Pa are small parts of the smallest error.",
       .equations = "(COMP-2), (ANCF-8)",
       .reference = Reference::kCrossFormulation,
       .metric = "rounding, and error in proportion to 1/alpha, / error "
                 "against the exact motion at the smallest step",
       .unit = "-",
       .bound = {.upper = 0.05,
                 .derivation = "a part r shifts the order of the last halving "
                               "by r / ln 2, 0.07 of the 0.1 allowed"},
       .measure = Floors});
  claims.push_back(
      {.id = "composition/between",
       .sentence = "Where steps neither resolve the penalty vibration nor are "
                   "long against it (1e9 Pa, 0.1 to 0.003 s), errors do not "
                   "fall with the order; they stay below what the penalty "
                   "itself changes.",
       .equations = "(COMP-2), (ANCF-8)",
       .reference = Reference::kCrossFormulation,
       .metric = "max error over 2 s against the same body at 0.0008 s / "
                 "difference of that from the rigid body",
       .unit = "-",
       .bound = {.upper = 1.0,
                 .derivation = "set: steps at most double what the penalty "
                               "errs. They misjudge the phase of a vibration "
                               "that the relaxed strain leaves, and parts in "
                               "resonance with it (order 6, 0.025 s) pump it"},
       .measure = Between});
  claims.push_back(
      {.id = "composition/conservation",
       .sentence = "Composed steps keep energy and angular momentum to "
                   "round-off.",
       .equations = "(COMP-2), (EM-1..5)",
       .reference = Reference::kExact,
       .metric = "largest relative error, every step",
       .unit = "-",
       .bound = {.upper = 1e-15,
                 .derivation =
                     "9 u, u = 2^-53, for 5e4 steps of 0.01 s: their 9e5 parts "
                     "have increments of 2e-3 of the values on average and "
                     "are rounded by u of themselves; as a random walk 950 of "
                     "one, 2 u for each of a few terms; the largest over the "
                     "steps is three times that"},
       .measure = Conservation});
  return claims;
}

}  // namespace emmy::verification
