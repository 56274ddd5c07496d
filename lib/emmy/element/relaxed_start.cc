#include "emmy/element/relaxed_start.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "emmy/numerics/rotation.h"

namespace emmy {

Vector6d RelaxedStrain(const AncfRigidBody& body, const Vector3d& omega_body) {
  const Matrix3d& inertia = body.inertia().tensor;
  const Vector3d angular_acceleration =
      -(inertia.inverse() * omega_body.cross(inertia * omega_body));
  const Matrix3d omega_hat = Hat(omega_body);
  const Matrix3d acceleration =
      omega_hat * omega_hat + Hat(angular_acceleration);
  const Matrix3d stress = -(body.second_moment() * acceleration.transpose());
  Vector6d strain;
  for (int i = 0; i < 3; ++i) {
    const auto [m, n] = AncfRigidBody::kShearPairs[static_cast<size_t>(i)];
    strain(i) = stress(i, i) / body.penalty_stiffness()(i);
    strain(3 + i) =
        0.5 * (stress(m, n) + stress(n, m)) / body.penalty_stiffness()(3 + i);
  }
  return strain;
}

absl::StatusOr<std::array<DoubleDouble3, 3>> StretchOfStrain(
    const Vector6d& strain) {
  Matrix3d e;
  e << strain(0), 0.5 * strain(3), 0.5 * strain(5),  //
      0.5 * strain(3), strain(1), 0.5 * strain(4),   //
      0.5 * strain(5), 0.5 * strain(4), strain(2);
  // The row sum bounds every eigenvalue and so the contraction of (ANCF-9).
  const double bound = e.cwiseAbs().rowwise().sum().maxCoeff();
  if (!(bound < 0.4)) {
    return absl::FailedPreconditionError(absl::StrFormat(
        "a relaxed start needs strains below 0.4, got up to %.3g", bound));
  }
  std::array<DoubleDouble3, 3> delta;
  for (size_t j = 0; j < 3; ++j) {
    delta[j] = DoubleDouble3::FromDouble(e.col(static_cast<int>(j)));
  }
  constexpr int kIterations = 200;  // 0.4^200 is far below 2^-106.
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    std::array<DoubleDouble3, 3> next;
    for (size_t j = 0; j < 3; ++j) {
      next[j] = DoubleDouble3::FromDouble(e.col(static_cast<int>(j)));
      for (size_t k = 0; k < 3; ++k) {
        const DoubleDouble factor =
            DoubleDouble(-0.5) * delta[j][static_cast<int>(k)];
        next[j] += factor * delta[k];
      }
    }
    delta = next;
  }
  for (size_t j = 0; j < 3; ++j) delta[j][static_cast<int>(j)] += 1.0;
  return delta;
}

}  // namespace emmy
