// What an ANCF body gives way at its joints, in its own frame [1/kg].
//
// With the constant tangent (EM-6) of the body, a unit impulse at a joint with
// weights h changes the rate of the joint with weights g by
//   Ŝ(g, h) = g₀ h₀ / M · 1 + Σᵢⱼ gᵢ hⱼ (K⁻¹)ᵢⱼ                     (EM-15)
// Principal second moments only.

#ifndef EMMY_INTEGRATE_JOINT_COMPLIANCE_H_
#define EMMY_INTEGRATE_JOINT_COMPLIANCE_H_

#include "emmy/base/types.h"
#include "emmy/element/ancf_rigid_body.h"
#include "emmy/integrate/structure.h"

namespace emmy {

// κ times the largest mass: small against S ~ 1/mass, large against its
// rounding.
inline constexpr double kJointShift = 1e-8;

class JointCompliance {
 public:
  JointCompliance(const AncfRigidBody& body, double time_step);

  // Ŝ(g, h) [1/kg]; row: direction of the rate, column: of the impulse.
  Matrix3d Between(const Vector4d& g, const Vector4d& h) const;

  // What φ, of size 1 about axis `axis`, adds to it.
  Matrix3d OfTurn(const Vector4d& g, const Vector4d& h, int axis) const;

  // What component `k` of the mean strain, of size 1, adds to it; shear strains
  // are sums of two entries of s.
  Matrix3d OfStrain(const Vector4d& g, const Vector4d& h, int k) const;

  // 1/(Mⁱⁱ + cᵢ), then 1/determinant of each shear pair; c of the shear pairs.
  const Vector6d& inverse() const { return inverse_; }
  Vector3d shear() const { return stress_.tail<3>(); }

 private:
  // (EM-6): column i belongs to eᵢ.
  Matrix3d Solve(const Matrix3d& y) const;
  // The same of a unit impulse along axis `axis` at a joint with weights h.
  Matrix3d OfImpulse(const Vector4d& h, int axis) const;

  double mass_;
  Vector3d moments_;
  Vector6d stress_;  // ¼ Δt² b
  Vector6d inverse_;
};

// κ of a structure.
double JointShift(const Structure& structure);

// Constants of a body (kNone: nothing, zeros are right) in one lane, with and
// without those of its joints.
void SetBodyConstants(const Structure& structure, int body, double time_step,
                      double* constants, size_t lane);
void SetJointConstants(const Structure& structure, int body, double time_step,
                       const Vector4d& right, const Vector4d& left,
                       double* constants, size_t lane);

}  // namespace emmy

#endif  // EMMY_INTEGRATE_JOINT_COMPLIANCE_H_
