// The tangent of a free ANCF body's step, constant in the co-rotated frame.
//
// In the frame Ē = [ē₁ ē₂ ē₃] at mid-step, nearly orthonormal, and without
// stress the Jacobian of the step's residual is constant. With
// cₖ = ¼ Δt² bₖ and xᵢⱼ = ēⱼ·Δwᵢ:
//   (Mⁱⁱ + cᵢ) xᵢᵢ = yᵢᵢ
//   [Mᵐ + c, c; c, Mⁿ + c] [xₘₙ; xₙₘ] = [yₘₙ; yₙₘ], c = c_l      (EM-6)
// for principal body axes, and a constant symmetric 9×9 system for any other
// Mⁱʲ. The residual stays exact; only the correction is approximate, so the
// solution is that of Newton's method. The error of a correction is of the
// order |ω|Δt + |ε| of itself.

#ifndef EMMY_INTEGRATE_COROTATED_TANGENT_H_
#define EMMY_INTEGRATE_COROTATED_TANGENT_H_

#include "emmy/base/types.h"
#include "emmy/element/ancf_rigid_body.h"

namespace emmy {

class CorotatedTangent {
 public:
  CorotatedTangent(const AncfRigidBody& body, double time_step);

  // x of (EM-6) for the residual y; entry (j, i) is the component of the
  // vector of eᵢ along ēⱼ.
  Matrix3d Solve(const Matrix3d& y) const;

 private:
  bool principal_ = false;
  Vector3d moments_ = Vector3d::Zero();  // Mⁱⁱ, principal axes only.
  Vector6d c_ = Vector6d::Zero();        // ¼ Δt² b
  Vector6d inverse_ = Vector6d::Zero();  // 1/(Mⁱⁱ + cᵢ), 1/determinants.
  Matrix9d general_inverse_ = Matrix9d::Zero();
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_COROTATED_TANGENT_H_
