// The strain that balances the rigid-body acceleration of an ANCF body.
//
// In body axes, with ω and ω̇ = −J⁻¹(ω × Jω):
//   A = Hat(ω)² + Hat(ω̇)        (aᵢ = A eᵢ is the rigid-body acceleration)
//   Sᵢⱼ = −Mⁱᵏ Aⱼₖ              (symmetric by Euler's equation)  [J]
//   εᵢ = Sᵢᵢ / bᵢ,  ε_l = Sₘₙ / b_l                               (ANCF-8)
// A body started so carries no penalty vibration to first order in 1/α, while
// a start without strain sets off one of velocity amplitude ∝ α^(−1/2).
//
// The stretch with that strain is U = 1 + δ, δ = E − ½ δ², where E holds
// εᵢ on its diagonal and ½ ε_l off it.                             (ANCF-9)

#ifndef EMMY_ELEMENT_RELAXED_START_H_
#define EMMY_ELEMENT_RELAXED_START_H_

#include <array>

#include "absl/status/statusor.h"
#include "emmy/base/double_double.h"
#include "emmy/base/types.h"
#include "emmy/element/ancf_rigid_body.h"

namespace emmy {

// (ANCF-8) for a torque-free body; `omega_body` [rad/s] in body axes.
Vector6d RelaxedStrain(const AncfRigidBody& body, const Vector3d& omega_body);

// U of (ANCF-9) by columns, in extended precision. Fails with
// kFailedPrecondition where a strain is so large (an eigenvalue of E outside
// (−0.4, 0.4)) that the fixed point need not exist: the penalty is too soft.
absl::StatusOr<std::array<DoubleDouble3, 3>> StretchOfStrain(
    const Vector6d& strain);

}  // namespace emmy

#endif  // EMMY_ELEMENT_RELAXED_START_H_
