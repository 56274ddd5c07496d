// Rotation matrices, unit quaternions and plane rotations for any real type.
//
//   exp(θ n̂) = 1 + sin θ n̂ + 2 sin²(½ θ) n̂ n̂,  |n| = 1            (TOP-2)
//   q = (cos ½θ, sin ½θ n),  q and −q are the same attitude.

#ifndef EMMY_VERIFICATION_EXACT_ATTITUDE_H_
#define EMMY_VERIFICATION_EXACT_ATTITUDE_H_

#include "verification/exact/real.h"

namespace emmy::exact {

// n̂: Hat(a) b = a × b.
template <typename T>
Matrix3<T> Hat(const Vector3<T>& a);

// (TOP-2) for the rotation vector θ n; the identity for zero.
template <typename T>
Matrix3<T> RotationFromVector(const Vector3<T>& rotation_vector);

// Of q / |q|, q = (w, x, y, z) finite and not zero.
template <typename T>
Matrix3<T> RotationFromQuaternion(const Vector4<T>& quaternion);

// (w, x, y, z) with |q| = 1 and w ≥ 0; accurate for every angle.
template <typename T>
Vector4<T> QuaternionFromRotation(const Matrix3<T>& rotation);

// The nearest rotation to `matrix`, which is one up to about 1e-3. Used to
// carry a rotation given in double into Quad.
template <typename T>
Matrix3<T> NearestRotation(const Matrix3<T>& matrix);

}  // namespace emmy::exact

#endif  // EMMY_VERIFICATION_EXACT_ATTITUDE_H_
