// Mass, inertia tensor and second moments of mass of a rigid body.
//
//   M = ∫ρ dV,  Mⁱʲ = ∫ρ ξⁱξʲ dV  [kg m²]                        (ANCF-2)
//   Mⁱʲ = ½ tr(J) δⁱʲ − Jⁱʲ,      Jⁱʲ = tr(M) δⁱʲ − Mⁱʲ           (ANCF-3)
//
// About the centre of mass, in body axes.

#ifndef EMMY_ELEMENT_RIGID_BODY_INERTIA_H_
#define EMMY_ELEMENT_RIGID_BODY_INERTIA_H_

#include "absl/status/statusor.h"
#include "emmy/base/export.h"
#include "emmy/base/types.h"

namespace emmy {

struct EMMY_EXPORT RigidBodyInertia {
  double mass = 0.0;                          // M [kg]
  double volume = 0.0;                        // V [m³], scales the penalty.
  Matrix3d second_moment = Matrix3d::Zero();  // Mⁱʲ [kg m²]
  Matrix3d tensor = Matrix3d::Zero();         // J [kg m²]

  // A homogeneous box with edges `size` [m] along the body axes:
  // Mⁱⁱ = M aᵢ² / 12. Arguments must be finite and positive.
  static RigidBodyInertia Box(const Vector3d& size, double density);

  // Fails with kInvalidArgument, naming the eigenvalue at fault, if the
  // second moments of the symmetric `tensor` are not positive definite: no
  // body of finite extent in three directions has such a tensor.
  static absl::StatusOr<RigidBodyInertia> FromTensor(double mass,
                                                     const Matrix3d& tensor,
                                                     double volume);
};

}  // namespace emmy

#endif  // EMMY_ELEMENT_RIGID_BODY_INERTIA_H_
