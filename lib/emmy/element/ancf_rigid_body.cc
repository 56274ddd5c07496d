#include "emmy/element/ancf_rigid_body.h"

#include <cmath>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "emmy/element/quadratic_strain.h"

namespace emmy {

absl::StatusOr<AncfRigidBody> AncfRigidBody::Create(
    const RigidBodyInertia& inertia, const Vector6d& penalty) {
  for (int k = 0; k < kNumStrains; ++k) {
    const double alpha = penalty(k);
    if (!std::isfinite(alpha) || !(alpha > 0.0)) {
      return absl::InvalidArgumentError(absl::StrFormat(
          "penalty/%d: must be a finite number > 0 [Pa], got %.17g", k, alpha));
    }
  }
  return AncfRigidBody(inertia, inertia.volume * penalty);
}

Vector6d AncfRigidBody::Strain(const Matrix3d& gradients) {
  Vector6d strain;
  for (int i = 0; i < 3; ++i) {
    strain(i) = 0.5 * (gradients.col(i).squaredNorm() - 1.0);
    const auto [m, n] = kShearPairs[static_cast<size_t>(i)];
    strain(3 + i) = gradients.col(m).dot(gradients.col(n));
  }
  return strain;
}

Vector6d AncfRigidBody::StrainIncrement(const Matrix3d& mean_gradients,
                                        const Matrix3d& gradient_increment) {
  Vector6d increment;
  for (int i = 0; i < 3; ++i) {
    increment(i) =
        NormalStrainIncrement(mean_gradients.col(i), gradient_increment.col(i));
    const auto [m, n] = kShearPairs[static_cast<size_t>(i)];
    increment(3 + i) = ProductStrainIncrement(
        mean_gradients.col(m), gradient_increment.col(m), mean_gradients.col(n),
        gradient_increment.col(n));
  }
  return increment;
}

double AncfRigidBody::PenaltyEnergy(const Vector6d& strain) const {
  return 0.5 * stiffness_.dot(strain.cwiseAbs2());
}

Matrix3d AncfRigidBody::InternalForce(const Matrix3d& gradients,
                                      const Vector6d& strain) const {
  const Vector6d stress = stiffness_.cwiseProduct(strain);
  Matrix3d force;
  for (int i = 0; i < 3; ++i) force.col(i) = stress(i) * gradients.col(i);
  for (int i = 0; i < 3; ++i) {
    const auto [m, n] = kShearPairs[static_cast<size_t>(i)];
    force.col(m) += stress(3 + i) * gradients.col(n);
    force.col(n) += stress(3 + i) * gradients.col(m);
  }
  return force;
}

}  // namespace emmy
