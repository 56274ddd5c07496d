#include "emmy/element/rigid_body_inertia.h"

#include <Eigen/Eigenvalues>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"

namespace emmy {

RigidBodyInertia RigidBodyInertia::Box(const Vector3d& size, double density) {
  RigidBodyInertia inertia;
  inertia.volume = size.prod();
  inertia.mass = density * inertia.volume;
  const Vector3d moments = (inertia.mass / 12.0) * size.cwiseAbs2();
  inertia.second_moment = moments.asDiagonal();
  inertia.tensor = Vector3d(moments(1) + moments(2), moments(2) + moments(0),
                            moments(0) + moments(1))
                       .asDiagonal();
  return inertia;
}

absl::StatusOr<RigidBodyInertia> RigidBodyInertia::FromTensor(
    double mass, const Matrix3d& tensor, double volume) {
  RigidBodyInertia inertia;
  inertia.mass = mass;
  inertia.volume = volume;
  inertia.tensor = tensor;
  inertia.second_moment = 0.5 * tensor.trace() * Matrix3d::Identity() - tensor;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(inertia.second_moment,
                                                       Eigen::EigenvaluesOnly);
  const Vector3d& moments = solver.eigenvalues();
  // Below this an eigenvalue is rounding of the subtraction, not a moment.
  const double least = 1e-14 * tensor.cwiseAbs().maxCoeff();
  if (!(moments(0) > least)) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "second moments tr(J)/2 - J must be positive definite [kg m^2], got "
        "the principal values (%.6g, %.6g, %.6g)",
        moments(0), moments(1), moments(2)));
  }
  return inertia;
}

}  // namespace emmy
