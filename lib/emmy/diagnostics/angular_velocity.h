// Three angular velocities of an ANCF body, all in the inertial frame [rad/s].
//
// With R = [e₁ e₂ e₃], Ṙ = [ė₁ ė₂ ė₃] and R = R̃ U (ATT-1):
//   polar        B = Ṙ U⁻¹ R̃ᵀ,  ω = axial(½ (B − Bᵀ))             (ATT-2)
//   polar_exact  (tr(U) 1 − U) ω_body = axial(R̃ᵀṘ − ṘᵀR̃),
//                ω = R̃ ω_body                                     (ATT-3)
//   locked       ω = J(e)⁻¹ Mⁱʲ eᵢ × ėⱼ,
//                J(e) = Mⁱʲ (eᵢ·eⱼ 1 − eᵢ eⱼᵀ)                     (ATT-4)
// (ATT-2) takes U̇ for commuting with U; (ATT-3) is the spin of R̃ itself;
// (ATT-4) sees the conserved angular momentum and not the penalty vibration.
// For a rotation R with Ṙ = Hat(ω) R all three are ω.

#ifndef EMMY_DIAGNOSTICS_ANGULAR_VELOCITY_H_
#define EMMY_DIAGNOSTICS_ANGULAR_VELOCITY_H_

#include "emmy/base/export.h"
#include "emmy/base/types.h"
#include "emmy/numerics/polar.h"

namespace emmy {

// (ATT-2); `polar` is the decomposition of R.
EMMY_EXPORT Vector3d PolarAngularVelocity(const PolarDecomposition& polar,
                                          const Matrix3d& rates);

// (ATT-3)
EMMY_EXPORT Vector3d ExactPolarAngularVelocity(const PolarDecomposition& polar,
                                               const Matrix3d& rates);

// (ATT-4)
EMMY_EXPORT Vector3d LockedAngularVelocity(const Matrix3d& second_moment,
                                           const Matrix3d& gradients,
                                           const Matrix3d& rates);

}  // namespace emmy

#endif  // EMMY_DIAGNOSTICS_ANGULAR_VELOCITY_H_
