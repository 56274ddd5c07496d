#include "emmy/diagnostics/angular_velocity.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "emmy/numerics/rotation.h"

namespace emmy {

Vector3d PolarAngularVelocity(const PolarDecomposition& polar,
                              const Matrix3d& rates) {
  return Axial(rates * polar.stretch.inverse() * polar.rotation.transpose());
}

Vector3d ExactPolarAngularVelocity(const PolarDecomposition& polar,
                                   const Matrix3d& rates) {
  const Matrix3d body_rates = polar.rotation.transpose() * rates;
  const Matrix3d system =
      polar.stretch.trace() * Matrix3d::Identity() - polar.stretch;
  return polar.rotation * (system.inverse() * (2.0 * Axial(body_rates)));
}

Vector3d LockedAngularVelocity(const Matrix3d& second_moment,
                               const Matrix3d& gradients,
                               const Matrix3d& rates) {
  Vector3d momentum = Vector3d::Zero();
  Matrix3d inertia = Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double moment = second_moment(i, j);
      momentum += moment * gradients.col(i).cross(rates.col(j));
      inertia += moment * (gradients.col(i).dot(gradients.col(j)) *
                               Matrix3d::Identity() -
                           gradients.col(i) * gradients.col(j).transpose());
    }
  }
  return inertia.inverse() * momentum;
}

}  // namespace emmy
