// Bodies that others have published, with their motion:
// reference_data/external/free_rigid_bodies.json.

#ifndef EMMY_VERIFICATION_RUNS_EXTERNAL_BODY_H_
#define EMMY_VERIFICATION_RUNS_EXTERNAL_BODY_H_

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "emmy/base/types.h"
#include "emmy/model/model_description.h"

namespace emmy::verification {

// What is known at one time.
struct ExternalState {
  double time = 0.0;  // [s]
  Matrix3d attitude;  // Body to inertial axes.
  Vector3d body_angular_velocity;
};

struct ExternalBody {
  std::string name;
  double mass = 0.0;               // [kg]
  Vector3d inertia;                // Principal moments, body axes [kg m²].
  Vector3d position;               // Of the centre of mass at time 0 [m].
  Vector3d velocity;               // [m/s]
  Vector3d gravity;                // [m/s²]
  Vector3d body_angular_velocity;  // [rad/s]
  std::vector<double> flip_times;  // Zeros of its middle component [s].
  std::vector<ExternalState> states;

  ModelDescription Conventional() const;
  // Relaxed; `stiffness` b [J], the same for all strains.
  ModelDescription Ancf(double stiffness) const;
};

// All bodies of the file.
absl::StatusOr<std::vector<ExternalBody>> ReadExternalBodies();

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_RUNS_EXTERNAL_BODY_H_
