// The conventional rigid body: centre of mass, attitude and body angular
// velocity; the comparator of the ANCF body.
//
//   J Ẇ + W × J W = 0,  Ṙ = R Hat(W)     (torque-free, body axes)  (CRB-1)
//   T = ½ M |x̄̇|² + ½ W·J W,  L = x̄ × M x̄̇ + R J W                 (CRB-2)
//
// One step with the mean angular velocity W̄ = ½ (W₀ + W₁) and the finite
// rotation vector Θ = Δt W̄ in Cayley form:
//   R₁ = R₀ cay(Θ),  R₁ J W₁ = R₀ J W₀                             (CRB-3)
//   which is the same as  J ΔW + Δt W̄ × J W̄ = 0                    (CRB-4)
// (CRB-4) keeps ½ W·JW and |JW|² exactly; (CRB-3) keeps L itself.
//
// Source: Simo and Wong, Int. J. Numer. Meth. Eng. 31 (1991).

#ifndef EMMY_ELEMENT_CONVENTIONAL_RIGID_BODY_H_
#define EMMY_ELEMENT_CONVENTIONAL_RIGID_BODY_H_

#include "emmy/base/types.h"
#include "emmy/element/rigid_body_inertia.h"

namespace emmy {

class ConventionalRigidBody {
 public:
  static constexpr int kNumPositions = 7;   // x̄, quaternion (w, x, y, z).
  static constexpr int kNumVelocities = 6;  // x̄̇ inertial, W in body axes.

  // `inertia` as made by RigidBodyInertia::Box or FromTensor; not checked.
  explicit ConventionalRigidBody(const RigidBodyInertia& inertia)
      : inertia_(inertia) {}

  // All of mass, volume, second moments and tensor.
  const RigidBodyInertia& inertia() const { return inertia_; }
  double mass() const { return inertia_.mass; }  // M [kg]
  // J [kg m²], body axes.
  const Matrix3d& tensor() const { return inertia_.tensor; }

 private:
  RigidBodyInertia inertia_;
};

}  // namespace emmy

#endif  // EMMY_ELEMENT_CONVENTIONAL_RIGID_BODY_H_
