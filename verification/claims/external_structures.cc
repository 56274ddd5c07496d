// Mechanisms and structures that others have published.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "absl/strings/str_format.h"
#include "emmy/diagnostics/structure_motion.h"
#include "verification/claims/groups.h"
#include "verification/exact/pendulum.h"
#include "verification/runs/external_table.h"
#include "verification/runs/extrapolation.h"
#include "verification/runs/fit.h"
#include "verification/runs/run.h"

namespace emmy::verification {
namespace {

using Read = std::function<VectorXd(const Run&)>;

// What `read` gives at the table's times after 0, one row a time.
absl::StatusOr<MatrixXd> ReadAtTimes(const ExternalTable& table,
                                     const ModelDescription& model,
                                     double time_step, const Read& read,
                                     const Scheme& scheme) {
  absl::StatusOr<Run> run = Run::Start(model, time_step, scheme);
  if (!run.ok()) return run.status();
  MatrixXd values(table.time.size() - 1, table.values.cols());
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    const absl::Status status = run->Advance(
        std::llround(table.time(i + 1) / time_step) - run->state().step);
    if (!status.ok()) return status;
    values.row(i) = read(*run).transpose();
  }
  return values;
}

// Steps h, h/2 and h/4, extrapolated twice: without the h² and h⁴ terms. One
// value a time: the largest error; notes say how the plain runs did.
absl::StatusOr<ClaimResult> ExtrapolatedErrors(const std::string& name,
                                               double largest_step,
                                               const Read& read,
                                               const Scheme& scheme) {
  const absl::StatusOr<ExternalTable> table = ReadExternalTable(name);
  if (!table.ok()) return table.status();
  const absl::StatusOr<ModelDescription> model = ReadExample(name);
  if (!model.ok()) return model.status();
  const auto motions = Extrapolate<MatrixXd>(largest_step, [&](double h) {
    return ReadAtTimes(*table, *model, h, read, scheme);
  });
  if (!motions.ok()) return motions.status();
  const MatrixXd& finest = motions->finest;
  const MatrixXd published = table->values.bottomRows(finest.rows());
  ClaimResult result;
  for (Eigen::Index i = 0; i < finest.rows(); ++i) {
    const auto error = [&](const MatrixXd& motion) {
      return (motion.row(i) - published.row(i)).cwiseAbs().maxCoeff();
    };
    const std::string label = absl::StrFormat("t = %g s", table->time(i + 1));
    result.values.push_back({label, error(finest)});
    result.notes.push_back(absl::StrFormat(
        "%s: %.2g, %.2g, %.2g at h, h/2, h/4, h = %g s; extrapolated once "
        "%.2g",
        label, error(motions->plain[0]), error(motions->plain[1]),
        error(motions->plain[2]), largest_step, error(motions->fine)));
  }
  return result;
}

// --- Andrews' mechanism. ---------------------------------------------------

// The source's angles β, Θ, γ, Φ, δ, Ω, ε, but for whole turns: the bodies K1
// to K7 are turned by β, β + Θ, γ, Φ + δ, δ, Ω + ε, ε about z.
VectorXd AndrewsAngles(const Run& run) {
  VectorXd turned(7);
  for (size_t k = 0; k < 7; ++k) {
    const Vector4d q = ObserveBody(run.model(), run.state(), k).quaternion;
    turned(static_cast<Eigen::Index>(k)) = 2.0 * std::atan2(q(3), q(0));
  }
  VectorXd angles(7);
  angles << turned(0), turned(1) - turned(0), turned(2), turned(3) - turned(4),
      turned(4), turned(5) - turned(6), turned(6);
  return angles;
}

absl::StatusOr<ClaimResult> Andrews(const ClaimSetting& setting) {
  const absl::StatusOr<ExternalTable> table =
      ReadExternalTable("andrews_squeezer");
  if (!table.ok()) return table.status();
  // The table's angles pass through whole turns, which an attitude does not
  // tell: each reading is the angle nearest to the table's.
  Eigen::Index row = 0;
  const Read read = [&table, &row](const Run& run) {
    row = row % (table->time.size() - 1) + 1;
    const VectorXd nearest = table->values.row(row).transpose();
    const VectorXd angles = AndrewsAngles(run);
    return VectorXd(nearest + (angles - nearest).unaryExpr([](double x) {
      return std::remainder(x, 2.0 * M_PI);
    }));
  };
  return ExtrapolatedErrors("andrews_squeezer", 1e-5, read, setting.scheme);
}

// --- Four particles. -------------------------------------------------------

absl::StatusOr<ClaimResult> FourParticles(const ClaimSetting& setting) {
  const Read read = [](const Run& run) {
    VectorXd positions(12);
    for (size_t k = 0; k < 4; ++k) {
      positions.segment<3>(3 * static_cast<Eigen::Index>(k)) =
          ObserveNode(run.model(), run.state(), k).position;
    }
    return positions;
  };
  return ExtrapolatedErrors("four_particles", 1.0 / 512.0, read,
                            setting.scheme);
}

// --- The pendulum over hundreds of periods. --------------------------------

// The time of the last of `count` passages through the vertical.
absl::StatusOr<double> PassageTime(const ModelDescription& model,
                                   double time_step, int count,
                                   const Scheme& scheme) {
  absl::StatusOr<Run> run = Run::Start(model, time_step, scheme);
  if (!run.ok()) return run.status();
  PointMotion before = ObserveNode(run->model(), run->state(), 0);
  for (;;) {
    const double time = static_cast<double>(run->state().step) * time_step;
    const absl::Status status = run->Advance(1);
    if (!status.ok()) return status;
    const PointMotion after = ObserveNode(run->model(), run->state(), 0);
    if ((before.position(0) > 0.0) != (after.position(0) > 0.0) &&
        --count == 0) {
      return time + ZeroOfCubic(time_step, before.position(0),
                                before.velocity(0), after.position(0),
                                after.velocity(0));
    }
    before = after;
  }
}

absl::StatusOr<ClaimResult> PendulumPhase(const ClaimSetting& setting) {
  const absl::StatusOr<ModelDescription> model = ReadExample("simple_pendulum");
  if (!model.ok()) return model.status();
  const exact::Pendulum<double> pendulum(1.0, 9.81, 0.5 * M_PI);
  const double half_period = 0.5 * pendulum.Period();
  const double duration = IsFull(setting) ? 2000.0 : 200.0;
  // The first passage is a quarter of a period after the release.
  const int count = static_cast<int>(std::lround(duration / half_period));
  const double expected = (count - 0.5) * half_period;
  const auto error =
      Extrapolate<double>(1.0 / 128.0, [&](double h) -> absl::StatusOr<double> {
        const absl::StatusOr<double> time =
            PassageTime(*model, h, count, setting.scheme);
        if (!time.ok()) return time.status();
        return *time - expected;
      });
  if (!error.ok()) return error.status();
  ClaimResult result;
  result.values.push_back({absl::StrFormat("passage %d", count),
                           std::abs(error->finest) / expected});
  result.notes.push_back(absl::StrFormat(
      "after %.6g s, late by %.3g, %.3g, %.3g s with h, h/2, h/4, h = 1/128 "
      "s; extrapolated once %.3g, twice %.3g s",
      expected, error->plain[0], error->plain[1], error->plain[2], error->fine,
      error->finest));
  return result;
}

}  // namespace

std::vector<Claim> ExternalStructureClaims() {
  std::vector<Claim> claims;
  claims.push_back(
      {.id = "external/andrews_angles",
       .sentence = "Andrews' squeezing mechanism, seven bodies in closed "
                   "loops, moves as published, by affine bodies and shared "
                   "points.",
       .equations = "(EM-9), (EM-12), (LINE-5); "
                    "reference_data/external/andrews_squeezer.json",
       .reference = Reference::kPublished,
       .metric = "largest error of the seven angles at 0.01 ... 0.05 s, "
                 "extrapolated from h, h/2, h/4, h = 1e-5 s",
       .unit = "rad",
       .bound = {.upper = 1e-8,
                 .derivation = "what the published angles are good for"},
       .measure = Andrews});
  claims.push_back(
      {.id = "external/four_particles",
       .sentence = "Four particles on two stiff and two soft trusses move as "
                   "published for rigid bars.",
       .equations = "(LINE-3), (EM-9); "
                    "reference_data/external/four_particles.json",
       .reference = Reference::kPublished,
       .metric = "largest error of a coordinate at 1 ... 10 s, extrapolated "
                 "from h, h/2, h/4, h = 1/512 s",
       .unit = "m",
       .bound = {.upper = 2e-8,
                 .derivation =
                     "a bar of EA = 1e10 N stretches by the force in it, about "
                     "m v^2 / l = 1 N, over EA = 1e-10; what that changes "
                     "grows by a hundred in 10 s, as errors of the step do"},
       .measure = FourParticles});
  claims.push_back(
      {.id = "external/pendulum_phase",
       .sentence = "A pendulum, a mass on a stiff truss, keeps the published "
                   "period over hundreds of swings.",
       .equations = "(PEN-4), (LINE-3); "
                    "reference_data/external/simple_pendulum.json",
       .reference = Reference::kPublished,
       .metric = "relative error of the time of the last passage, "
                 "extrapolated from h, h/2, h/4, h = 1/128 s",
       .unit = "-",
       .bound = {.upper = 3e-8,
                 .derivation =
                     "the largest tension 3 m g stretches the truss of EA = "
                     "1e9 N by 2.9e-8, and the period, which goes as the root "
                     "of the length, by less. 2000 s: 6e-5 s, 3e-4 m, a third "
                     "of what the definition accepts"},
       .measure = PendulumPhase});
  return claims;
}

}  // namespace emmy::verification
