#include "emmy/integrate/corotated_tangent.h"

#include <Eigen/Cholesky>

namespace emmy {

CorotatedTangent::CorotatedTangent(const AncfRigidBody& body,
                                   double time_step) {
  const Matrix3d& moment = body.second_moment();
  c_ = (0.25 * time_step * time_step) * body.penalty_stiffness();
  const Matrix3d diagonal = moment.diagonal().asDiagonal();
  principal_ = moment == diagonal;
  if (principal_) {
    moments_ = moment.diagonal();
    for (int i = 0; i < 3; ++i) {
      inverse_(i) = 1.0 / (moments_(i) + c_(i));
      const auto [m, n] = AncfRigidBody::kShearPairs[static_cast<size_t>(i)];
      // The determinant without the cancellation of c² − c².
      inverse_(3 + i) = 1.0 / (moments_(m) * moments_(n) +
                               c_(3 + i) * (moments_(m) + moments_(n)));
    }
    return;
  }
  Matrix9d tangent = Matrix9d::Zero();
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      for (int j = 0; j < 3; ++j) tangent(3 * i + j, 3 * k + j) = moment(i, k);
    }
  }
  for (int i = 0; i < 3; ++i) {
    tangent(3 * i + i, 3 * i + i) += c_(i);
    const auto [m, n] = AncfRigidBody::kShearPairs[static_cast<size_t>(i)];
    const int mn = 3 * m + n;
    const int nm = 3 * n + m;
    tangent(mn, mn) += c_(3 + i);
    tangent(mn, nm) += c_(3 + i);
    tangent(nm, mn) += c_(3 + i);
    tangent(nm, nm) += c_(3 + i);
  }
  general_inverse_ = tangent.ldlt().solve(Matrix9d::Identity());
}

Matrix3d CorotatedTangent::Solve(const Matrix3d& y) const {
  Matrix3d x;
  if (!principal_) {
    Eigen::Map<Vector9d>(x.data()).noalias() =
        general_inverse_ * Eigen::Map<const Vector9d>(y.data());
    return x;
  }
  for (int i = 0; i < 3; ++i) {
    x(i, i) = inverse_(i) * y(i, i);
    const auto [m, n] = AncfRigidBody::kShearPairs[static_cast<size_t>(i)];
    const double shear = c_(3 + i) * (y(n, m) - y(m, n));
    x(n, m) = inverse_(3 + i) * (moments_(n) * y(n, m) + shear);
    x(m, n) = inverse_(3 + i) * (moments_(m) * y(m, n) - shear);
  }
  return x;
}

}  // namespace emmy
