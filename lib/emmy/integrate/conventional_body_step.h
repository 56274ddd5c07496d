// One energy-momentum step of a free conventional body: (CRB-3), (CRB-4).
//
// Unknown: ΔW, body axes. W̄ = W₀ + ½ ΔW, Θ = Δt W̄:
//   J ΔW + Δt W̄ × J W̄ = 0                                         (CRB-4)
// by Newton's method with the exact Jacobian
//   J + ½ Δt (Hat(W̄) J − Hat(J W̄))                                (CRB-5)
// to round-off. The residual of the accepted ΔW in double-double arithmetic
// gives ΔW a low-order part, without which energy errors have a small mean of
// their own and grow faster than a random walk. Then the quaternion advances by
// its increment (ROT-5).

#ifndef EMMY_INTEGRATE_CONVENTIONAL_BODY_STEP_H_
#define EMMY_INTEGRATE_CONVENTIONAL_BODY_STEP_H_

#include <Eigen/LU>

#include "emmy/base/compensated_sum.h"
#include "emmy/base/types.h"
#include "emmy/element/conventional_rigid_body.h"
#include "emmy/integrate/ancf_body_step.h"
#include "emmy/numerics/newton.h"

namespace emmy {

// A body at the start of a step: values, and what compensated sums keep of
// them.
struct ConventionalBodyStart {
  Vector4d quaternion;
  Vector4d quaternion_compensation;
  Vector3d angular_velocity;  // W₀, body axes.
  Vector3d angular_velocity_compensation;
};

// What a step adds to a body, but for its centre.
struct ConventionalBodyIncrement {
  Vector4d quaternion = Vector4d::Zero();
  Vector3d angular_velocity = Vector3d::Zero();      // ΔW
  Vector3d angular_velocity_low = Vector3d::Zero();  // Its low-order part.
};

class ConventionalBodyStep {
 public:
  ConventionalBodyStep(const ConventionalRigidBody& body, double time_step,
                       const NewtonOptions& options)
      : body_(body),
        time_step_(time_step),
        options_(options),
        inverse_tensor_(body.tensor().inverse()) {}

  BodyStepResult Solve(const ConventionalBodyStart& start,
                       const Vector3d& increment_guess,
                       ConventionalBodyIncrement* increment) const;

 private:
  Vector3d ExtendedResidual(const ConventionalBodyStart& start,
                            const Vector3d& change) const;
  Matrix3d Jacobian(const Vector3d& mean, const Vector3d& momentum) const;

  ConventionalRigidBody body_;
  double time_step_;
  NewtonOptions options_;
  Matrix3d inverse_tensor_;  // J⁻¹
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_CONVENTIONAL_BODY_STEP_H_
