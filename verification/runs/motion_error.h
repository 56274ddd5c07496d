// How far a run of the paper's box is from the motion of a rigid body.

#ifndef EMMY_VERIFICATION_RUNS_MOTION_ERROR_H_
#define EMMY_VERIFICATION_RUNS_MOTION_ERROR_H_

#include <vector>

#include "absl/status/statusor.h"
#include "emmy/base/types.h"
#include "emmy/diagnostics/body_motion.h"
#include "emmy/integrate/energy_momentum.h"
#include "emmy/model/model_description.h"
#include "verification/runs/scheme.h"

namespace emmy::verification {

// Largest errors over some times.
struct MotionError {
  double angular_velocity = 0.0;  // Inertial, largest component [rad/s].
  double attitude = 0.0;          // Angle between the attitudes [rad].
};

// The angle between two attitudes, without cancellation near zero.
double AngleBetween(const Vector4d& a, const Vector4d& b);

// When a run is read: at `interval`, 2 `interval`, … `duration` [s]; both are
// whole numbers of its steps.
struct ReadingTimes {
  double interval = 0.0;
  double duration = 0.0;
};

// The first body of a run at the reading times.
absl::StatusOr<std::vector<BodyMotion>> ReadMotion(
    const ModelDescription& description, const IntegratorOptions& options,
    const ReadingTimes& times, const Scheme& scheme);

// The same of the paper's box as a rigid body, in closed form (TOP-6..9).
absl::StatusOr<std::vector<BodyMotion>> ExactMotion(const ReadingTimes& times);

// Of `motion` against `truth`; locked angular velocities. NaN where one is.
MotionError LargestError(const std::vector<BodyMotion>& motion,
                         const std::vector<BodyMotion>& truth);

// A run against the exact motion.
absl::StatusOr<MotionError> CompareWithExact(
    const ModelDescription& description, const IntegratorOptions& options,
    const ReadingTimes& times, const Scheme& scheme);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_RUNS_MOTION_ERROR_H_
