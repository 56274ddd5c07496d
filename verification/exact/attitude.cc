#include "verification/exact/attitude.h"

#include <cmath>

namespace emmy::exact {

using std::cos;
using std::sin;
using std::sqrt;

template <typename T>
Matrix3<T> Hat(const Vector3<T>& a) {
  Matrix3<T> hat;
  hat << T{0}, -a(2), a(1),  //
      a(2), T{0}, -a(0),     //
      -a(1), a(0), T{0};
  return hat;
}

template <typename T>
Matrix3<T> RotationFromVector(const Vector3<T>& rotation_vector) {
  const T scale = rotation_vector.cwiseAbs().maxCoeff();
  if (scale == 0) return Matrix3<T>::Identity();
  const Vector3<T> scaled = rotation_vector / scale;
  const T length = sqrt(scaled.squaredNorm());
  // By way of the quaternion, whose norm is divided out: Boost reduces a large
  // argument of sin and cos with an error of its own, which would otherwise
  // show as a loss of orthogonality.
  const T half_angle = scale * length / 2;
  const Vector3<T> v = scaled * (sin(half_angle) / length);
  return RotationFromQuaternion(Vector4<T>(cos(half_angle), v(0), v(1), v(2)));
}

template <typename T>
Matrix3<T> RotationFromQuaternion(const Vector4<T>& quaternion) {
  const Vector4<T> scaled = quaternion / quaternion.cwiseAbs().maxCoeff();
  const T two_over_square = 2 / scaled.squaredNorm();
  const Matrix3<T> v = Hat<T>(scaled.template tail<3>());
  return Matrix3<T>::Identity() + two_over_square * (scaled(0) * v + v * v);
}

template <typename T>
Vector4<T> QuaternionFromRotation(const Matrix3<T>& r) {
  // 4 q qᵀ: its row with the largest diagonal entry is free of cancellation.
  Eigen::Matrix<T, 4, 4> product;
  const Vector3<T> axial(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0),
                         r(1, 0) - r(0, 1));
  const T trace = r.trace();
  product(0, 0) = 1 + trace;
  for (int i = 0; i < 3; ++i) {
    product(0, i + 1) = axial(i);
    product(i + 1, 0) = axial(i);
    for (int j = 0; j < 3; ++j) product(i + 1, j + 1) = r(i, j) + r(j, i);
    product(i + 1, i + 1) += 1 - trace;
  }
  int best = 0;
  for (int i = 1; i < 4; ++i) {
    if (product(i, i) > product(best, best)) best = i;
  }
  const Vector4<T> row = product.row(best).transpose();
  const Vector4<T> q = row / sqrt(row.squaredNorm());
  return q(0) < 0 ? Vector4<T>(-q) : q;
}

template <typename T>
Matrix3<T> NearestRotation(const Matrix3<T>& matrix) {
  Matrix3<T> r = matrix;
  // Quadratically convergent: 1e-3 → 1e-6 → … → 1e-48.
  for (int i = 0; i < 5; ++i) {
    const Matrix3<T> excess = r.transpose() * r - Matrix3<T>::Identity();
    r = (r - r * excess / 2).eval();
  }
  return r;
}

#define EMMY_INSTANTIATE(T)                                      \
  template Matrix3<T> Hat(const Vector3<T>&);                    \
  template Matrix3<T> RotationFromVector(const Vector3<T>&);     \
  template Matrix3<T> RotationFromQuaternion(const Vector4<T>&); \
  template Vector4<T> QuaternionFromRotation(const Matrix3<T>&); \
  template Matrix3<T> NearestRotation(const Matrix3<T>&)

EMMY_INSTANTIATE(double);
EMMY_INSTANTIATE(Quad);
#undef EMMY_INSTANTIATE

}  // namespace emmy::exact
