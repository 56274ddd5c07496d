#include "emmy/numerics/rotation.h"

#include <array>
#include <cmath>

namespace emmy {

Matrix3d Hat(const Vector3d& a) {
  Matrix3d m;
  m << 0.0, -a(2), a(1),  //
      a(2), 0.0, -a(0),   //
      -a(1), a(0), 0.0;
  return m;
}

Vector3d Axial(const Matrix3d& m) {
  return 0.5 *
         Vector3d(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1));
}

Matrix3d CayleyRotation(const Vector3d& theta) {
  return QuaternionToMatrix(
      Vector4d(1.0, 0.5 * theta(0), 0.5 * theta(1), 0.5 * theta(2)));
}

Vector4d QuaternionProduct(const Vector4d& q, const Vector4d& p) {
  return {q(0) * p(0) - q(1) * p(1) - q(2) * p(2) - q(3) * p(3),
          q(0) * p(1) + q(1) * p(0) + q(2) * p(3) - q(3) * p(2),
          q(0) * p(2) - q(1) * p(3) + q(2) * p(0) + q(3) * p(1),
          q(0) * p(3) + q(1) * p(2) - q(2) * p(1) + q(3) * p(0)};
}

Vector4d CayleyQuaternionIncrement(const Vector4d& q0, const Vector3d& theta) {
  const double quarter_square = 0.25 * theta.squaredNorm();
  const double n = std::sqrt(1.0 + quarter_square);
  const Vector3d vector = (0.5 / n) * theta;
  return QuaternionProduct(q0, Vector4d(-quarter_square / (n * (1.0 + n)),
                                        vector(0), vector(1), vector(2)));
}

Matrix3d QuaternionToMatrix(const Vector4d& q) {
  const double scale = 2.0 / q.squaredNorm();
  const double w = q(0);
  const double x = q(1);
  const double y = q(2);
  const double z = q(3);
  Matrix3d r;
  r << 1.0 - scale * (y * y + z * z), scale * (x * y - w * z),
      scale * (x * z + w * y),  //
      scale * (x * y + w * z), 1.0 - scale * (x * x + z * z),
      scale * (y * z - w * x),  //
      scale * (x * z - w * y), scale * (y * z + w * x),
      1.0 - scale * (x * x + y * y);
  return r;
}

std::array<DoubleDouble3, 3> QuaternionToMatrix(
    const std::array<DoubleDouble, 4>& q) {
  const auto& [w, x, y, z] = q;
  const DoubleDouble one(1.0);
  const DoubleDouble scale =
      DoubleDouble(2.0) / (w * w + x * x + y * y + z * z);
  return {{{{one - scale * (y * y + z * z), scale * (x * y + w * z),
             scale * (x * z - w * y)}},
           {{scale * (x * y - w * z), one - scale * (x * x + z * z),
             scale * (y * z + w * x)}},
           {{scale * (x * z + w * y), scale * (y * z - w * x),
             one - scale * (x * x + y * y)}}}};
}

Vector4d MatrixToQuaternion(const Matrix3d& r) {
  // The largest of the four squares is at least 1, which keeps the divisor
  // away from zero.
  const Vector4d four_squares(
      1.0 + r(0, 0) + r(1, 1) + r(2, 2), 1.0 + r(0, 0) - r(1, 1) - r(2, 2),
      1.0 - r(0, 0) + r(1, 1) - r(2, 2), 1.0 - r(0, 0) - r(1, 1) + r(2, 2));
  Eigen::Index largest = 0;
  const double four_square = four_squares.maxCoeff(&largest);
  Vector4d q;
  switch (largest) {
    case 0:
      q << four_square, r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1);
      break;
    case 1:
      q << r(2, 1) - r(1, 2), four_square, r(1, 0) + r(0, 1), r(0, 2) + r(2, 0);
      break;
    case 2:
      q << r(0, 2) - r(2, 0), r(1, 0) + r(0, 1), four_square, r(2, 1) + r(1, 2);
      break;
    default:
      q << r(1, 0) - r(0, 1), r(0, 2) + r(2, 0), r(2, 1) + r(1, 2), four_square;
      break;
  }
  q /= q.norm();
  return q(0) < 0.0 ? Vector4d(-q) : q;
}

Vector4d RotationVectorToQuaternion(const Vector3d& v) {
  const double angle = v.norm();
  // sin(½ a) / a, whose limit at a = 0 is ½.
  const double factor = angle > 0.0 ? std::sin(0.5 * angle) / angle : 0.5;
  return {std::cos(0.5 * angle), factor * v(0), factor * v(1), factor * v(2)};
}

}  // namespace emmy
