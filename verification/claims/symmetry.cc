// What must not matter: the direction of time, where an observer stands and how
// he moves, and in which sequence the parts of a model are named.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "emmy/diagnostics/structure_motion.h"
#include "emmy/numerics/rotation.h"
#include "emmy/numerics/unit_roundoff.h"
#include "verification/claims/groups.h"
#include "verification/runs/motion_error.h"
#include "verification/runs/paper_box.h"
#include "verification/runs/run.h"

namespace emmy::verification {
namespace {

constexpr double kTimeStep = 0.01;  // [s]
constexpr int64_t kNumSteps = 1000;
constexpr double kDuration = 10.0;  // [s]
constexpr double kSpeed = 1.0;      // |ω| of the paper's box [rad/s]

// What a start wrong by u may come to: it turns on with the error of ω.
constexpr double kUnit = kUnitRoundoff * (1.0 + kSpeed * kDuration);

struct NamedModel {
  std::string name;
  ModelDescription model;
};

std::vector<NamedModel> Models() {
  return {{"ancf", PaperBoxAncf(1e10)},
          {"conventional", PaperBoxConventional()},
          {"with a truss", PaperTrussAncf(1e10)}};
}

// In flight, off the origin.
ModelDescription Flying(ModelDescription model) {
  for (RigidBodyDescription& body : model.rigid_bodies) {
    body.position += Vector3d(2.0, -1.0, 0.5);
    body.velocity += Vector3d(0.3, 0.2, -0.1);
  }
  for (NodeDescription& node : model.nodes) {
    node.position += Vector3d(2.0, -1.0, 0.5);
  }
  return model;
}

void TurnTimeRound(State* state) {
  for (CompensatedVector* v : {&state->velocity, &state->end_velocity}) {
    v->value = -v->value;
    v->compensation = -v->compensation;
  }
}

absl::StatusOr<ClaimResult> TimeReversal(const ClaimSetting& setting) {
  ClaimResult result;
  for (const NamedModel& named : Models()) {
    for (const int order : {2, 4}) {
      absl::StatusOr<Run> run =
          Run::Start(Flying(named.model),
                     {.order = order, .time_step = kTimeStep}, setting.scheme);
      if (!run.ok()) return run.status();
      const BodyMotion start = run->Motion();
      for (int way = 0; way < 2; ++way) {
        const absl::Status status = run->Advance(kNumSteps);
        if (!status.ok()) return status;
        TurnTimeRound(&run->state());
      }
      const BodyMotion end = run->Motion();
      const std::string label = absl::StrCat(named.name, ", order ", order);
      result.values.push_back(
          {absl::StrCat(label, ", attitude"),
           AngleBetween(start.quaternion, end.quaternion) / kUnit});
      result.values.push_back(
          {absl::StrCat(label, ", angular velocity"),
           (start.omega_locked - end.omega_locked).norm() / kUnit});
    }
  }
  return result;
}

// The start as one sees it who is turned by `turn` and moves at `velocity`.
ModelDescription SeenFrom(const Matrix3d& turn, const Vector3d& velocity,
                          ModelDescription model) {
  for (RigidBodyDescription& body : model.rigid_bodies) {
    body.position = turn * body.position;
    body.velocity = turn * body.velocity + velocity;
    body.angular_velocity = turn * body.angular_velocity;
    const Vector4d q = MatrixToQuaternion(turn);
    body.orientation = Quaternion{q(0), q(1), q(2), q(3)};
  }
  for (NodeDescription& node : model.nodes) {
    node.position = turn * node.position;
  }
  return model;
}

absl::StatusOr<ClaimResult> Objectivity(const ClaimSetting& setting) {
  const Matrix3d turn = CayleyRotation(Vector3d(0.7, -1.9, 0.4));
  const Vector3d velocity(-0.2, 0.5, 0.3);
  ClaimResult result;
  for (const NamedModel& named : Models()) {
    const ModelDescription model = Flying(named.model);
    absl::StatusOr<Run> run = Run::Start(model, kTimeStep, setting.scheme);
    if (!run.ok()) return run.status();
    absl::StatusOr<Run> seen =
        Run::Start(SeenFrom(turn, velocity, model), kTimeStep, setting.scheme);
    if (!seen.ok()) return seen.status();
    for (Run* each : {&*run, &*seen}) {
      const absl::Status status = each->Advance(kNumSteps);
      if (!status.ok()) return status;
    }
    const BodyMotion expected = run->Motion();
    const BodyMotion actual = seen->Motion();
    const Vector4d attitude =
        MatrixToQuaternion(turn * QuaternionToMatrix(expected.quaternion));
    const Vector3d position = turn * expected.position + kDuration * velocity;
    const double size = position.norm() + kDuration;
    result.values.push_back(
        {absl::StrCat(named.name, ", attitude"),
         AngleBetween(actual.quaternion, attitude) / kUnit});
    result.values.push_back(
        {absl::StrCat(named.name, ", angular velocity"),
         (actual.omega_locked - turn * expected.omega_locked).norm() / kUnit});
    result.values.push_back(
        {absl::StrCat(named.name, ", position"),
         (actual.position - position).norm() / (kUnitRoundoff * size)});
  }
  return result;
}

// A chain of three boxes with nodes and trusses; the parts named forward or
// backward.
ModelDescription Chain(bool backward) {
  ModelDescription model;
  for (int i = 0; i < 3; ++i) {
    RigidBodyDescription box = PaperBoxAncf(1e8).rigid_bodies[0];
    box.name = absl::StrCat("box ", i);
    box.position = Vector3d(4.0 * i, 0.3 * i, 0.0);
    box.velocity = box.angular_velocity.cross(box.position);
    model.rigid_bodies.push_back(box);
  }
  for (int i = 0; i < 2; ++i) {
    TrussDescription truss;
    truss.name = absl::StrCat("truss ", i);
    truss.ends = {BodyPoint{absl::StrCat("box ", i), {1.5, 0.0, 0.0}},
                  BodyPoint{absl::StrCat("box ", i + 1), {-1.5, 0.0, 0.0}}};
    truss.area = 1e-4;
    truss.density = 2700.0;
    truss.young_modulus = 7e9;
    model.trusses.push_back(truss);
  }
  if (backward) {
    std::reverse(model.rigid_bodies.begin(), model.rigid_bodies.end());
    std::reverse(model.trusses.begin(), model.trusses.end());
  }
  return model;
}

// Structures amplify: the same perturbation of the start, of 1000 u and so
// above rounding, tells by how much.
absl::StatusOr<ClaimResult> Permutation(const ClaimSetting& setting) {
  constexpr double kKick = 1e3 * kUnitRoundoff;
  ModelDescription kicked = Chain(false);
  kicked.rigid_bodies[0].angular_velocity *= 1.0 + kKick;
  std::vector<std::vector<BodyMotion>> motions;
  for (const ModelDescription& model : {Chain(false), Chain(true), kicked}) {
    absl::StatusOr<Run> run = Run::Start(model, 1e-3, setting.scheme);
    if (!run.ok()) return run.status();
    const absl::Status status = run->Advance(500);
    if (!status.ok()) return status;
    std::vector<BodyMotion> motion;
    for (size_t i = 0; i < 3; ++i) {
      motion.push_back(ObserveBody(run->model(), run->state(), i));
    }
    motions.push_back(motion);
  }
  std::reverse(motions[1].begin(), motions[1].end());
  const MotionError error = LargestError(motions[1], motions[0]);
  const MotionError kick = LargestError(motions[2], motions[0]);
  return ClaimResult{
      .values = {{"angular velocity",
                  error.angular_velocity / kick.angular_velocity * 1e3},
                 {"attitude", error.attitude / kick.attitude * 1e3}},
      .figures = {},
      .notes = {}};
}

constexpr char kDerivation[] =
    "each of 1000 steps rounds by u of its increment, 0.01 of the values: as "
    "a random walk 0.3 u for each of some ten terms, and start and reading by "
    "a few u; what omega errs by turns the body for the rest of the time";

}  // namespace

std::vector<Claim> SymmetryClaims() {
  std::vector<Claim> claims;
  claims.push_back(
      {.id = "symmetry/time_reversal",
       .sentence = "A thousand steps, velocities turned round, and a thousand "
                   "steps lead back to the start.",
       .equations = "(EM-1), (EM-2), (CRB-3), (CRB-8), (COMP-2)",
       .reference = Reference::kExact,
       .metric = "error / (u (1 + omega T)), T = 10 s",
       .unit = "u",
       .bound = {.upper = 8.0, .derivation = kDerivation},
       .measure = TimeReversal});
  claims.push_back(
      {.id = "symmetry/objectivity",
       .sentence = "An observer who is turned and moves sees the same motion.",
       .equations = "(KIN-1), (QS-2), (EM-2), (CRB-3)",
       .reference = Reference::kExact,
       .metric = "error / (u (1 + omega T)), of positions / (u size), "
                 "T = 10 s",
       .unit = "u",
       .bound = {.upper = 8.0, .derivation = kDerivation},
       .measure = Objectivity});
  claims.push_back(
      {.id = "symmetry/permutation",
       .sentence = "The sequence in which bodies and trusses are named does "
                   "not matter.",
       .equations = "(EM-9), (EM-10)",
       .reference = Reference::kExact,
       .metric = "difference of two sequences / that made by a change of the "
                 "start by u; 500 steps of 1 ms",
       .unit = "u",
       .bound = {.upper = 32.0,
                 .derivation =
                     "sums of a few terms in another sequence, a few u in the "
                     "start and sqrt(500) roundings of increments of 1e-3 "
                     "and, of stiff trusses, 1e-1 of the values"},
       .measure = Permutation});
  return claims;
}

}  // namespace emmy::verification
