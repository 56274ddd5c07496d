// Conventional bodies joined at shared points: kept laws, closed joints, and
// the limit that joined ANCF bodies approach.

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "emmy/diagnostics/extended_state.h"
#include "verification/claims/groups.h"
#include "verification/models/large_models.h"
#include "verification/runs/fit.h"
#include "verification/runs/paper_box.h"
#include "verification/runs/run.h"

namespace emmy::verification {
namespace {

absl::StatusOr<ClaimResult> ChainLaws(const ClaimSetting& setting) {
  const int64_t steps = IsFull(setting) ? 10000 : 1000;
  ClaimResult result;
  for (const int boxes : {10, 100}) {
    const absl::StatusOr<ConservationErrors> errors =
        MeasureConservation(ConventionalBoxChain(boxes).model, kPaperTimeStep,
                            10 * steps / boxes, setting.scheme);
    if (!errors.ok()) return errors.status();
    const std::string name = absl::StrFormat("%d boxes", boxes);
    result.values.push_back({name + ", energy", errors->energy});
    result.values.push_back({name + ", momentum", errors->momentum});
    result.values.push_back(
        {name + ", angular momentum", errors->angular_momentum});
  }
  result.notes.push_back(
      absl::StrFormat("%d steps of 1 ms for 10 boxes, a tenth for 100", steps));
  return result;
}

// x_c1 − x_c2, beyond a double.
Vector3d GapOf(const Run& run, const ModelJoint& joint) {
  const Point& second = joint.points[1];
  DoubleDouble3 place = ExtendedPosition(run.model(), run.state(), second);
  const std::array<DoubleDouble3, 3> frame = ExtendedFrame(
      run.model().bodies()[*second.conventional_body], run.state());
  for (int i = 0; i < 3; ++i) {
    place += DoubleDouble(joint.rest(i)) * frame[static_cast<size_t>(i)];
  }
  return (ExtendedPosition(run.model(), run.state(), joint.points[0]) - place)
      .ToDouble();
}

// |v| + |ω| |ξ| of the fastest point [m/s].
double LargestSpeed(const Run& run) {
  double largest = 0.0;
  for (const ModelJoint& joint : run.model().joints()) {
    for (const Point& point : joint.points) {
      const Eigen::Index w =
          run.model().bodies()[*point.conventional_body].velocity_offset;
      const VectorXd& rates = run.state().velocity.value;
      largest = std::max(largest,
                         rates.segment<3>(w).norm() +
                             rates.segment<3>(w + 3).norm() * point.xi.norm());
    }
  }
  return largest;
}

absl::StatusOr<ClaimResult> ChainGaps(const ClaimSetting& setting) {
  const int64_t steps = IsFull(setting) ? 100000 : 2000;
  absl::StatusOr<Run> run = Run::Start(ConventionalBoxChain(10).model,
                                       kPaperTimeStep, setting.scheme);
  if (!run.ok()) return run.status();
  double gap = 0.0;
  double speed = 0.0;
  const absl::Status status = run->Advance(steps, [&](const Run& now) {
    speed = std::max(speed, LargestSpeed(now));
    for (const ModelJoint& joint : now.model().joints()) {
      const double size = GapOf(now, joint).norm();
      if (!(size <= gap)) gap = size;  // NaN stays.
    }
  });
  if (!status.ok()) return status;
  ClaimResult result;
  result.values.push_back(
      {"10 boxes", gap / (0x1p-53 * kPaperTimeStep * speed)});
  result.notes.push_back(
      absl::StrFormat("largest gap %.2g m, every one of %d steps", gap, steps));
  return result;
}

// max |x − x of the conventional chain| over every step and box [m].
absl::StatusOr<double> ChainDistance(double penalty, int64_t steps,
                                     const Scheme& scheme) {
  constexpr int kBoxes = 4;
  ModelDescription soft = BoxChain(kBoxes).model;
  for (RigidBodyDescription& box : soft.rigid_bodies) box.penalty = penalty;
  absl::StatusOr<Run> ancf = Run::Start(soft, kPaperTimeStep, scheme);
  if (!ancf.ok()) return ancf.status();
  absl::StatusOr<Run> rigid =
      Run::Start(ConventionalBoxChain(kBoxes).model, kPaperTimeStep, scheme);
  if (!rigid.ok()) return rigid.status();
  double distance = 0.0;
  const absl::Status status = ancf->Advance(steps, [&](const Run& now) {
    // A step that fails leaves the state, and a distance that tells.
    static_cast<void>(rigid->Step());
    for (size_t i = 0; i < now.model().bodies().size(); ++i) {
      const double size =
          (ObserveBody(now.model(), now.state(), i).position -
           ObserveBody(rigid->model(), rigid->state(), i).position)
              .norm();
      if (!(size <= distance)) distance = size;  // NaN stays.
    }
  });
  if (!status.ok()) return status;
  return distance;
}

absl::StatusOr<ClaimResult> ChainExponent(const ClaimSetting& setting) {
  const std::vector<double> penalties =
      PowersOfTen(6, 10, IsFull(setting) ? 1 : 2);
  std::vector<double> distances;
  ClaimResult result;
  for (const double penalty : penalties) {
    const absl::StatusOr<double> distance =
        ChainDistance(penalty, 5000, setting.scheme);
    if (!distance.ok()) return distance.status();
    distances.push_back(*distance);
    result.notes.push_back(
        absl::StrFormat("%s: %.3g m", PenaltyLabel(penalty), *distance));
  }
  result.values = {{"exponent", FitPower(penalties, distances)}};
  return result;
}

}  // namespace

std::vector<Claim> ConventionalJointClaims() {
  std::vector<Claim> claims;
  claims.push_back(
      {.id = "structures/conventional_chain_conservation",
       .sentence = "A chain of conventional boxes joined by shared points "
                   "keeps energy, momentum and angular momentum to round-off.",
       .equations = "(CRB-6), (CRB-7), (CONJ-1), (CONJ-3)",
       .reference = Reference::kExact,
       .metric = "largest relative error, every step",
       .unit = "-",
       .bound = {.upper = 1e-15,
                 .derivation =
                     "9 u, u = 2^-53: a step's increments are 1e-3 of the "
                     "values and rounded by u of themselves; they add up as a "
                     "random walk, below u for each of a few terms, and the "
                     "largest over the steps is three times that"},
       .measure = ChainLaws});
  claims.push_back(
      {.id = "structures/conventional_chain_joints",
       .sentence = "Its joints stay closed: what rounding leaves of a gap is "
                   "closed by the next step.",
       .equations = "(CONJ-1)",
       .reference = Reference::kExact,
       .metric = "largest gap of a joint / (u dt largest speed), every step",
       .unit = "u",
       .bound = {.upper = 24.0,
                 .derivation = "the increments of two bodies in one step, a "
                               "dozen roundings each, however many steps"},
       .measure = ChainGaps});
  claims.push_back(
      {.id = "structures/chain_exponent",
       .sentence = "A chain of ANCF boxes approaches that of conventional ones "
                   "as 1/alpha.",
       .equations = "(EM-9), (CONJ-1)",
       .reference = Reference::kCrossFormulation,
       .metric = "p of C alpha^p, alpha = 1e6 ... 1e10 Pa: max |x - x of the "
                 "conventional box| over 5 s, dt = 1 ms",
       .unit = "-",
       .bound = {.lower = -1.1,
                 .upper = -0.9,
                 .derivation =
                     "p = -1: strains, and with them places, are wrong by "
                     "forces over b; ten per cent for the ends"},
       .measure = ChainExponent});
  return claims;
}

}  // namespace emmy::verification
