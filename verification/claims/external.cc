// Free bodies that others have published.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "absl/strings/str_format.h"
#include "emmy/base/larger.h"
#include "emmy/numerics/rotation.h"
#include "emmy/numerics/unit_roundoff.h"
#include "verification/claims/groups.h"
#include "verification/runs/external_body.h"
#include "verification/runs/extrapolation.h"
#include "verification/runs/fit.h"
#include "verification/runs/run.h"

namespace emmy::verification {
namespace {

// Strains below 2e-12: two thousand times less than the flips allow.
constexpr double kStiffness = 1e13;  // b [J]

struct NamedModel {
  std::string name;
  ModelDescription model;
};

std::vector<NamedModel> BothFormulations(const ExternalBody& body) {
  return {{body.name + ", ancf", body.Ancf(kStiffness)},
          {body.name + ", conventional", body.Conventional()}};
}

Vector3d BodyOmega(const BodyMotion& motion) {
  return QuaternionToMatrix(motion.quaternion).transpose() *
         motion.omega_locked;
}

// Attitude by rows, then the angular velocity in body axes, at each of the
// body's times after 0; one column a time.
absl::StatusOr<MatrixXd> MotionAtTimes(const ExternalBody& body,
                                       const ModelDescription& description,
                                       double time_step, const Scheme& scheme) {
  absl::StatusOr<Run> run = Run::Start(description, time_step, scheme);
  if (!run.ok()) return run.status();
  MatrixXd motions(12, static_cast<Eigen::Index>(body.states.size()) - 1);
  for (Eigen::Index i = 0; i < motions.cols(); ++i) {
    const double time = body.states[static_cast<size_t>(i) + 1].time;
    const absl::Status status =
        run->Advance(std::llround(time / time_step) - run->state().step);
    if (!status.ok()) return status;
    const BodyMotion motion = run->Motion();
    const Matrix3d transposed =
        QuaternionToMatrix(motion.quaternion).transpose();
    motions.col(i) << Eigen::Map<const Vector9d>(transposed.data()),
        BodyOmega(motion);
  }
  return motions;
}

MatrixXd PublishedMotion(const ExternalBody& body) {
  MatrixXd motions(12, static_cast<Eigen::Index>(body.states.size()) - 1);
  for (Eigen::Index i = 0; i < motions.cols(); ++i) {
    const ExternalState& state = body.states[static_cast<size_t>(i) + 1];
    const Matrix3d transposed = state.attitude.transpose();
    motions.col(i) << Eigen::Map<const Vector9d>(transposed.data()),
        state.body_angular_velocity;
  }
  return motions;
}

// Three steps h, h/2, h/4 give two extrapolations without the h² term. If the
// method has the order two and the limit is the published motion, the second
// is wrong by 1/15 of their difference.
absl::StatusOr<ClaimResult> Extrapolated(const ClaimSetting& setting) {
  const absl::StatusOr<std::vector<ExternalBody>> bodies = ReadExternalBodies();
  if (!bodies.ok()) return bodies.status();
  ClaimResult result;
  constexpr double kLargest = 1.0 / 256.0;  // h [s]
  for (const ExternalBody& body : *bodies) {
    const MatrixXd published = PublishedMotion(body);
    for (const NamedModel& named : BothFormulations(body)) {
      const auto motions = Extrapolate<MatrixXd>(kLargest, [&](double h) {
        return MotionAtTimes(body, named.model, h, setting.scheme);
      });
      if (!motions.ok()) return motions.status();
      const MatrixXd& fine = motions->fine;
      const auto ratio = [&](int row, int count) {
        const double expected = (motions->coarse - fine)
                                    .middleRows(row, count)
                                    .cwiseAbs()
                                    .maxCoeff() /
                                15.0;
        return (fine - published).middleRows(row, count).cwiseAbs().maxCoeff() /
               expected;
      };
      result.values.push_back({named.name + ", attitude", ratio(0, 9)});
      result.values.push_back({named.name + ", angular velocity", ratio(9, 3)});
      result.notes.push_back(absl::StrFormat(
          "%s: error at h/4 = %.3g s: %.2g, extrapolated %.2g", named.name,
          kLargest / 4.0, (motions->plain[2] - published).cwiseAbs().maxCoeff(),
          (fine - published).cwiseAbs().maxCoeff()));
    }
  }
  return result;
}

absl::StatusOr<std::vector<double>> FlipTimes(
    const ExternalBody& body, const ModelDescription& description,
    double time_step, const Scheme& scheme) {
  absl::StatusOr<Run> run = Run::Start(description, time_step, scheme);
  if (!run.ok()) return run.status();
  // ω₂ and its rate by Euler's equation.
  const auto middle = [&body](const Run& at) {
    const Vector3d w = BodyOmega(at.Motion());
    const Vector3d& j = body.inertia;
    return std::pair<double, double>(w(1), (j(2) - j(0)) * w(2) * w(0) / j(1));
  };
  std::vector<double> times;
  std::pair<double, double> before = middle(*run);
  while (times.size() < body.flip_times.size() &&
         static_cast<double>(run->state().step) * time_step <
             body.flip_times.back() + 1.0) {
    // By the step that was asked for, not by what the state says of itself.
    const double time = static_cast<double>(run->state().step) * time_step;
    const absl::Status status = run->Advance(1);
    if (!status.ok()) return status;
    const std::pair<double, double> after = middle(*run);
    if ((before.first > 0.0) != (after.first > 0.0)) {
      times.push_back(time + ZeroOfCubic(time_step, before.first, before.second,
                                         after.first, after.second));
    }
    before = after;
  }
  return times;
}

absl::StatusOr<ClaimResult> Flips(const ClaimSetting& setting) {
  const absl::StatusOr<std::vector<ExternalBody>> bodies = ReadExternalBodies();
  if (!bodies.ok()) return bodies.status();
  constexpr double kTimeStep = 1e-4;
  ClaimResult result;
  for (const ExternalBody& body : *bodies) {
    if (body.flip_times.empty()) continue;
    for (const NamedModel& named : BothFormulations(body)) {
      const absl::StatusOr<std::vector<double>> times =
          FlipTimes(body, named.model, kTimeStep, setting.scheme);
      if (!times.ok()) return times.status();
      for (size_t i = 0; i < body.flip_times.size(); ++i) {
        // A flip that did not happen has no time.
        const double time = i < times->size()
                                ? (*times)[i]
                                : std::numeric_limits<double>::quiet_NaN();
        result.values.push_back(
            {absl::StrFormat("%s, flip %d", named.name, i + 1),
             std::abs(time - body.flip_times[i]) / body.flip_times[i]});
      }
    }
  }
  result.notes.push_back(
      "steps of 1e-4 s; zeros of the cubic through rates and values");
  return result;
}

absl::StatusOr<ClaimResult> Positions(const ClaimSetting& setting) {
  const absl::StatusOr<std::vector<ExternalBody>> bodies = ReadExternalBodies();
  if (!bodies.ok()) return bodies.status();
  ClaimResult result;
  for (const ExternalBody& body : *bodies) {
    for (const NamedModel& named : BothFormulations(body)) {
      absl::StatusOr<Run> run = Run::Start(named.model, 1e-3, setting.scheme);
      if (!run.ok()) return run.status();
      double worst = 0.0;
      for (int second = 1; second <= 10; ++second) {
        const absl::Status status = run->Advance(1000);
        if (!status.ok()) return status;
        const double t = second;
        const Vector3d exact =
            body.position + t * body.velocity + (0.5 * t * t) * body.gravity;
        const double scale =
            (body.position.cwiseAbs() + t * body.velocity.cwiseAbs() +
             (0.5 * t * t) * body.gravity.cwiseAbs())
                .maxCoeff();
        worst = Larger(worst, (run->Motion().position - exact)
                                      .cwiseAbs()
                                      .maxCoeff<Eigen::PropagateNaN>() /
                                  (kUnitRoundoff * scale));
      }
      result.values.push_back({named.name, worst});
    }
  }
  return result;
}

}  // namespace

std::vector<Claim> ExternalClaims() {
  std::vector<Claim> claims;
  claims.push_back(
      {.id = "external/flip_times",
       .sentence = "The published asymmetric box, spun about its middle axis, "
                   "flips when it should, in both formulations.",
       .equations = "(TOP-11); reference_data/external/free_rigid_bodies.json",
       .reference = Reference::kPublished,
       .metric = "relative error of the times at which omega_2 = 0",
       .unit = "-",
       .bound = {.upper = 1e-6,
                 .derivation =
                     "set; the step is chosen for it: (omega dt)^2 / 12 = "
                     "2e-8 of every rate, times the sensitivity of a flip, "
                     "about ten"},
       .measure = Flips});
  claims.push_back(
      {.id = "external/motion",
       .sentence = "Both published bodies move, in both formulations, as they "
                   "should up to the step's second order, over 10 s.",
       .equations = "(EM-1..3), (CRB-3..5); "
                    "reference_data/external/free_rigid_bodies.json",
       .reference = Reference::kPublished,
       .metric = "error of the value extrapolated from h, h/2, h/4 / its "
                 "expectation, h = 1/256 s",
       .unit = "-",
       .bound = {.upper = 2.0,
                 .derivation =
                     "Richardson: with an error a h^2 + b h^4 the "
                     "extrapolated value is wrong by 1/15 of the difference "
                     "of two extrapolations, ratio 1; two allows for h^6"},
       .measure = Extrapolated});
  claims.push_back(
      {.id = "external/positions",
       .sentence = "The published bodies fall on their parabola exactly: "
                   "constant gravity is integrated without error.",
       .equations = "(EM-4)",
       .reference = Reference::kExact,
       .metric = "largest error of the centre of mass / u (|x0| + |v0| t + |g| "
                 "t^2 / 2), t = 1 ... 10 s",
       .unit = "-",
       .bound = {.upper = 6.0,
                 .derivation =
                     "dt, its product with g and the mean velocity, its "
                     "product with dt, the sum, and the formula compared "
                     "with: six roundings of relative size u"},
       .measure = Positions});
  return claims;
}

}  // namespace emmy::verification
