// What the results say of one body at one time.

#ifndef EMMY_DIAGNOSTICS_BODY_MOTION_H_
#define EMMY_DIAGNOSTICS_BODY_MOTION_H_

#include <cstddef>

#include "emmy/base/export.h"
#include "emmy/base/types.h"
#include "emmy/model/model.h"
#include "emmy/model/state.h"

namespace emmy {

// Inertial frame. The attitude of an ANCF body is R̃ of (ATT-1); quaternions
// are (w, x, y, z) of unit length with w ≥ 0. For a conventional body all
// three angular velocities are R W. The attitude and the polar angular
// velocities are NaN for an ANCF body turned inside out (det R ≤ 0).
struct BodyMotion {
  Vector3d position;           // Centre of mass [m].
  Vector3d velocity;           // [m/s]
  Vector4d quaternion;         // Attitude.
  Vector3d omega_locked;       // (ATT-4) [rad/s]
  Vector3d omega_polar;        // (ATT-2)
  Vector3d omega_polar_exact;  // (ATT-3)
};

// `body` is an index of model.bodies().
EMMY_EXPORT BodyMotion ObserveBody(const Model& model, const State& state,
                                   size_t body);

}  // namespace emmy

#endif  // EMMY_DIAGNOSTICS_BODY_MOTION_H_
