#include "verification/runs/motion_error.h"

#include <algorithm>
#include <cmath>

#include "emmy/base/larger.h"
#include "emmy/model/model_builder.h"
#include "emmy/numerics/rotation.h"
#include "verification/exact/free_rigid_body.h"
#include "verification/runs/paper_box.h"
#include "verification/runs/run.h"

namespace emmy::verification {
namespace {

int64_t NumReadings(const ReadingTimes& times) {
  return std::llround(times.duration / times.interval);
}

}  // namespace

// NaN stays: std::min returns its first argument if it cannot compare.
double AngleBetween(const Vector4d& a, const Vector4d& b) {
  const Vector4d nearer = a.dot(b) < 0.0 ? Vector4d(-b) : b;
  return 4.0 * std::asin(std::min(0.5 * (a - nearer).norm(), 1.0));
}

absl::StatusOr<std::vector<BodyMotion>> ReadMotion(
    const ModelDescription& description, const IntegratorOptions& options,
    const ReadingTimes& times, const Scheme& scheme) {
  absl::StatusOr<Run> run = Run::Start(description, options, scheme);
  if (!run.ok()) return run.status();
  const int64_t between = std::llround(times.interval / options.time_step);
  std::vector<BodyMotion> motion;
  for (int64_t i = 0; i < NumReadings(times); ++i) {
    const absl::Status status = run->Advance(between);
    if (!status.ok()) return status;
    motion.push_back(run->Motion());
  }
  return motion;
}

absl::StatusOr<std::vector<BodyMotion>> ExactMotion(const ReadingTimes& times) {
  const ModelDescription description = PaperBoxConventional();
  const absl::StatusOr<BuiltModel> built = BuildModel(description);
  if (!built.ok()) return built.status();
  exact::FreeRigidBodyStart<double> start;
  start.inertia = built->model.bodies()[0].inertia().tensor;
  start.angular_velocity = description.rigid_bodies[0].angular_velocity;
  const absl::StatusOr<exact::FreeRigidBody<double>> body =
      exact::FreeRigidBody<double>::Create(start);
  if (!body.ok()) return body.status();
  std::vector<BodyMotion> motion;
  for (int64_t i = 1; i <= NumReadings(times); ++i) {
    const exact::FreeRigidBodyState<double> truth =
        body->At(static_cast<double>(i) * times.interval);
    const Vector3d& omega = truth.angular_velocity;
    motion.push_back({.position = Vector3d::Zero(),
                      .velocity = Vector3d::Zero(),
                      .quaternion = MatrixToQuaternion(truth.attitude),
                      .omega_locked = omega,
                      .omega_polar = omega,
                      .omega_polar_exact = omega});
  }
  return motion;
}

MotionError LargestError(const std::vector<BodyMotion>& motion,
                         const std::vector<BodyMotion>& truth) {
  MotionError error;
  for (size_t i = 0; i < motion.size(); ++i) {
    const Vector3d difference = motion[i].omega_locked - truth[i].omega_locked;
    for (const double component : difference) {
      error.angular_velocity =
          Larger(error.angular_velocity, std::abs(component));
    }
    error.attitude = Larger(error.attitude, AngleBetween(motion[i].quaternion,
                                                         truth[i].quaternion));
  }
  return error;
}

absl::StatusOr<MotionError> CompareWithExact(
    const ModelDescription& description, const IntegratorOptions& options,
    const ReadingTimes& times, const Scheme& scheme) {
  const absl::StatusOr<std::vector<BodyMotion>> truth = ExactMotion(times);
  if (!truth.ok()) return truth.status();
  const absl::StatusOr<std::vector<BodyMotion>> motion =
      ReadMotion(description, options, times, scheme);
  if (!motion.ok()) return motion.status();
  return LargestError(*motion, *truth);
}

}  // namespace emmy::verification
