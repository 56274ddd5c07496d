// The vibration of the penalty: its frequency, its amplitude, and what a
// relaxed start leaves of it.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_format.h"
#include "emmy/base/larger.h"
#include "emmy/element/relaxed_start.h"
#include "verification/claims/groups.h"
#include "verification/runs/fit.h"
#include "verification/runs/paper_box.h"
#include "verification/runs/run.h"

namespace emmy::verification {
namespace {

// Angular frequencies of the strains of a body at rest [rad/s]: √(b/Mⁱⁱ), and
// √(b (1/Mᵐᵐ + 1/Mⁿⁿ)) for shear.                                   (VIB-1)
Vector6d Frequencies(const AncfRigidBody& body) {
  const Vector3d moment = body.second_moment().diagonal();
  const Vector6d& stiffness = body.penalty_stiffness();
  Vector6d frequencies;
  for (int i = 0; i < 3; ++i) {
    frequencies(i) = std::sqrt(stiffness(i) / moment(i));
    const auto [m, n] = AncfRigidBody::kShearPairs[static_cast<size_t>(i)];
    frequencies(3 + i) =
        std::sqrt(stiffness(3 + i) * (1.0 / moment(m) + 1.0 / moment(n)));
  }
  return frequencies;
}

const AncfRigidBody& Element(const Run& run) {
  return *run.model().bodies()[0].ancf();
}

constexpr double kAmplitude = 1e-8;  // Of the strain.

// A body at rest, set going in one strain. Of a sine sampled in steps of the
// phase θ, εₙ₋₁ + εₙ₊₁ = 2 cos θ εₙ.
absl::StatusOr<ClaimResult> Frequency(const ClaimSetting& setting) {
  ModelDescription description = PaperBoxAncf(1e10);
  description.rigid_bodies[0].angular_velocity.setZero();
  const absl::StatusOr<Run> still =
      Run::Start(description, 1.0, EnergyMomentumScheme);
  if (!still.ok()) return still.status();
  const Vector6d frequencies = Frequencies(Element(*still));
  const Vector3d moment = Element(*still).second_moment().diagonal();
  ClaimResult result;
  for (int k = 0; k < AncfRigidBody::kNumStrains; ++k) {
    const double frequency = frequencies(k);
    const double time_step = 0.3 / frequency;
    absl::StatusOr<Run> run =
        Run::Start(description, time_step, setting.scheme);
    if (!run.ok()) return run.status();
    // Velocities of e₁, e₂, e₃ from index 3; of a shear without a turn.
    const auto rate = [&run](int vector, int component) -> double& {
      return run->state().velocity.value(3 + 3 * vector + component);
    };
    if (k < 3) {
      rate(k, k) = kAmplitude * frequency;
    } else {
      const auto [m, n] =
          AncfRigidBody::kShearPairs[static_cast<size_t>(k - 3)];
      rate(m, n) = kAmplitude * frequency * moment(n) / (moment(m) + moment(n));
      rate(n, m) = kAmplitude * frequency * moment(m) / (moment(m) + moment(n));
    }
    std::vector<double> strain = {0.0};
    const absl::Status status = run->Advance(200, [&](const Run& advanced) {
      strain.push_back(advanced.state().strain.value(k));
    });
    if (!status.ok()) return status;
    double product = 0.0;
    double square = 0.0;
    double largest = 0.0;
    for (size_t i = 1; i + 1 < strain.size(); ++i) {
      product += strain[i] * (strain[i - 1] + strain[i + 1]);
      square += 2.0 * strain[i] * strain[i];
      largest = Larger(largest, std::abs(strain[i]));
    }
    const double phase = std::acos(product / square);
    const double expected = 2.0 * std::atan(0.5 * frequency * time_step);
    result.values.push_back({absl::StrFormat("strain %d", k + 1),
                             std::abs(phase / expected - 1.0)});
    result.notes.push_back(absl::StrFormat(
        "strain %d: %.6g rad/s, seen as %.6g rad/s by steps of %.3g s; "
        "amplitude %.3g",
        k + 1, frequency, phase / time_step, time_step, largest));
  }
  return result;
}

// An undeformed, turning body: each strain swings between zero and twice the
// strain that the rotation needs, as a spring does that is loaded at once.
absl::StatusOr<ClaimResult> Amplitude(const ClaimSetting& setting) {
  constexpr double kStep = 1e-5;
  absl::StatusOr<Run> run =
      Run::Start(PaperBoxAncf(1e10), kStep, setting.scheme);
  if (!run.ok()) return run.status();
  const Vector6d frequencies = Frequencies(Element(*run));
  const Vector6d needed = RelaxedStrain(
      Element(*run), PaperBoxAncf(1e10).rigid_bodies[0].angular_velocity);
  // In units of twice the relaxed strain.
  Vector6d largest = Vector6d::Zero();
  constexpr double kTurn = 2.0 * 3.141592653589793;
  const auto period =
      static_cast<int64_t>(kTurn / (kStep * frequencies.minCoeff()));
  for (int64_t i = 1; i <= period; ++i) {
    const absl::Status status = run->Advance(1);
    if (!status.ok()) return status;
    for (int k = 0; k < AncfRigidBody::kNumStrains; ++k) {
      // Its own first period.
      if (static_cast<double>(i) * kStep * frequencies(k) > kTurn) continue;
      const double strain = run->state().strain.value(k);
      largest(k) = Larger(largest(k), strain / (2.0 * needed(k)));
    }
  }
  ClaimResult result;
  for (int k = 0; k < AncfRigidBody::kNumStrains; ++k) {
    result.values.push_back({absl::StrFormat("strain %d", k + 1), largest(k)});
  }
  return result;
}

// How far the strain of a relaxed start gets from the one that the rotation of
// the moment needs.
absl::StatusOr<ClaimResult> Relaxed(const ClaimSetting& setting) {
  const std::vector<double> penalties =
      IsFull(setting) ? std::vector<double>{1e6, 1e7, 1e8, 1e9}
                      : std::vector<double>{1e6, 1e7, 1e8};
  std::vector<double> distances;
  ClaimResult result;
  for (const double penalty : penalties) {
    const ModelDescription description = PaperBoxAncf(penalty, Start::kRelaxed);
    const absl::StatusOr<Run> still =
        Run::Start(description, 1.0, EnergyMomentumScheme);
    if (!still.ok()) return still.status();
    const double time_step = 0.2 / Frequencies(Element(*still)).maxCoeff();
    absl::StatusOr<Run> run =
        Run::Start(description, time_step, setting.scheme);
    if (!run.ok()) return run.status();
    double distance = 0.0;
    double size = 0.0;
    const absl::Status status =
        run->Advance(std::llround(1.0 / time_step), [&](const Run& advanced) {
          const BodyMotion motion = advanced.Motion();
          const Vector4d& q = motion.quaternion;
          const Eigen::Quaterniond attitude(q(0), q(1), q(2), q(3));
          const Vector6d needed = RelaxedStrain(
              Element(advanced), attitude.conjugate() * motion.omega_locked);
          const Vector6d strain = advanced.state().strain.value.head<6>();
          distance = Larger(distance, (strain - needed).cwiseAbs().maxCoeff());
          size = Larger(size, needed.cwiseAbs().maxCoeff());
        });
    if (!status.ok()) return status;
    distances.push_back(distance);
    result.notes.push_back(absl::StrFormat(
        "%s: %.2g of a strain of %.2g", PenaltyLabel(penalty), distance, size));
  }
  result.values = {{"exponent", FitPower(penalties, distances)}};
  return result;
}

}  // namespace

std::vector<Claim> VibrationClaims() {
  std::vector<Claim> claims;
  claims.push_back(
      {.id = "vibration/frequency",
       .sentence = "A body at rest vibrates in each strain with the frequency "
                   "of the linear theory, as slow as the step makes it.",
       .equations = "(VIB-1), (VIB-2)",
       .reference = Reference::kExact,
       .metric = "|phase of a step / (2 atan(omega dt / 2)) - 1|, "
                 "omega dt = 0.3",
       .unit = "-",
       .bound = {.upper = 1e-8,
                 .derivation =
                     "the strain is quadratic in the coordinates: amplitude "
                     "a = 1e-8 adds a^2 / 4 of offset and second harmonic, a "
                     "relative part below a"},
       .measure = Frequency});
  claims.push_back(
      {.id = "vibration/amplitude",
       .sentence = "Started undeformed, each strain swings up to twice the one "
                   "that the rotation needs.",
       .equations = "(ANCF-8), (VIB-1)",
       .reference = Reference::kExact,
       .metric = "largest strain of the first period / (2 relaxed strain), "
                 "1e10 Pa",
       .unit = "-",
       .bound = {.lower = 0.99,
                 .upper = 1.01,
                 .derivation =
                     "sampled at omega dt = 0.02 ... 0.08, off the top by "
                     "(omega dt)^2 / 8 < 1e-3; in half a period the body turns "
                     "by 1e-3 rad and the strain it needs changes by a few of "
                     "it"},
       .measure = Amplitude});
  claims.push_back(
      {.id = "vibration/relaxed_exponent",
       .sentence = "Started relaxed, the strain stays the one that the "
                   "rotation needs, better than to first order in 1/alpha.",
       .equations = "(ANCF-8)",
       .reference = Reference::kExact,
       .metric = "p of max |strain - relaxed strain of the moment| over 1 s = "
                 "C alpha^p, steps that resolve the vibration",
       .unit = "-",
       .bound = {.lower = -1.6,
                 .upper = -1.4,
                 .derivation =
                     "p = -3/2: the strain is relaxed, its rate of 1/alpha is "
                     "not, and over a period of alpha^(-1/2) makes a vibration "
                     "of alpha^(-3/2); ten per cent for the second order of "
                     "strains, alpha^(-2). An undeformed start gives -1"},
       .measure = Relaxed});
  return claims;
}

}  // namespace emmy::verification
