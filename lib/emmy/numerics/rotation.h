// Rotations: the hat map, the Cayley map, quaternions and rotation vectors.
//
//   Hat(a) b = a × b                                              (ROT-1)
//   Axial(Hat(a)) = a; of any matrix: the axial vector of its
//   antisymmetric part                                            (ROT-2)
//   cay(Θ) = (1 − ½ Hat(Θ))⁻¹ (1 + ½ Hat(Θ))                      (ROT-3)
//   as a quaternion: (1, ½ Θ) / √(1 + ¼ Θ·Θ)                      (ROT-4)
//
// A unit quaternion (w, x, y, z) turns body axes into inertial axes:
// v_inertial = R v_body. No function here calls trigonometry except
// RotationVectorToQuaternion, which is used for input only.

#ifndef EMMY_NUMERICS_ROTATION_H_
#define EMMY_NUMERICS_ROTATION_H_

#include <array>

#include "emmy/base/double_double.h"
#include "emmy/base/types.h"

namespace emmy {

// (ROT-1)
Matrix3d Hat(const Vector3d& a);

// (ROT-2)
Vector3d Axial(const Matrix3d& m);

// (ROT-3), through (ROT-4).
Matrix3d CayleyRotation(const Vector3d& theta);

// The product q ⊗ p of quaternions (w, x, y, z).
Vector4d QuaternionProduct(const Vector4d& q, const Vector4d& p);

// The increment q₁ − q₀ of the unit quaternion q₁ = q₀ ⊗ cay(Θ), Θ in body
// axes, without cancellation:
//   Δq = q₀ ⊗ (−¼ Θ·Θ / (n (1 + n)), ½ Θ / n),  n = √(1 + ¼ Θ·Θ)   (ROT-5)
Vector4d CayleyQuaternionIncrement(const Vector4d& q0, const Vector3d& theta);

// Rotation matrix of a quaternion of any non-zero length.
Matrix3d QuaternionToMatrix(const Vector4d& q);

// The same in extended precision, by columns: orthonormal to 1e-31.
std::array<DoubleDouble3, 3> QuaternionToMatrix(
    const std::array<DoubleDouble, 4>& q);

// Unit quaternion with w ≥ 0 of a rotation matrix.
Vector4d MatrixToQuaternion(const Matrix3d& rotation);

// Unit quaternion of the rotation by |v| about v [rad].
Vector4d RotationVectorToQuaternion(const Vector3d& v);

}  // namespace emmy

#endif  // EMMY_NUMERICS_ROTATION_H_
