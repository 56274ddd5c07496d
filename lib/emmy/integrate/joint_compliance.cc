#include "emmy/integrate/joint_compliance.h"

#include <algorithm>

#include "emmy/integrate/body_packs.h"
#include "emmy/integrate/joint_chain_kernel.h"
#include "emmy/integrate/joint_graph.h"
#include "emmy/numerics/rotation.h"

namespace emmy {

JointCompliance::JointCompliance(const AncfRigidBody& body, double time_step)
    : mass_(body.mass()),
      moments_(body.second_moment().diagonal()),
      stress_((0.25 * time_step * time_step) * body.penalty_stiffness()) {
  const Vector6d& c = stress_;
  for (int i = 0; i < 3; ++i) {
    inverse_(i) = 1.0 / (moments_(i) + c(i));
    const auto [m, n] = AncfRigidBody::kShearPairs[static_cast<size_t>(i)];
    // The determinant without the cancellation of c² − c².
    inverse_(3 + i) = 1.0 / (moments_(m) * moments_(n) +
                             c(3 + i) * (moments_(m) + moments_(n)));
  }
}

Matrix3d JointCompliance::Solve(const Matrix3d& y) const {
  Matrix3d x;
  for (int i = 0; i < 3; ++i) {
    x(i, i) = inverse_(i) * y(i, i);
    const auto [m, n] = AncfRigidBody::kShearPairs[static_cast<size_t>(i)];
    const double shear = stress_(3 + i) * (y(n, m) - y(m, n));
    x(n, m) = inverse_(3 + i) * (moments_(n) * y(n, m) + shear);
    x(m, n) = inverse_(3 + i) * (moments_(m) * y(m, n) - shear);
  }
  return x;
}

Matrix3d JointCompliance::OfImpulse(const Vector4d& h, int axis) const {
  return Solve(Vector3d::Unit(axis) * h.tail<3>().transpose());
}

Matrix3d JointCompliance::Between(const Vector4d& g, const Vector4d& h) const {
  Matrix3d s = (g(0) * h(0) / mass_) * Matrix3d::Identity();
  for (int b = 0; b < 3; ++b) {
    s.col(b) += OfImpulse(h, b) * g.tail<3>();
  }
  return s;
}

Matrix3d JointCompliance::OfTurn(const Vector4d& g, const Vector4d& h,
                                 int axis) const {
  const Matrix3d turn = Hat(Vector3d::Unit(axis));
  const Matrix3d s =
      Between(g, h) - (g(0) * h(0) / mass_) * Matrix3d::Identity();
  Matrix3d change = turn * s + s * turn;
  for (int b = 0; b < 3; ++b) {
    const Matrix3d turned = turn * OfImpulse(h, b) * moments_.asDiagonal();
    change.col(b) -= 2.0 * (Solve(turned) * g.tail<3>());
  }
  return change;
}

Matrix3d JointCompliance::OfStrain(const Vector4d& g, const Vector4d& h,
                                   int k) const {
  const auto pair = static_cast<size_t>(k);
  const auto [m, n] = k < 3 ? AncfRigidBody::VectorPair{k, k}
                            : AncfRigidBody::kShearPairs[pair - 3];
  Matrix3d strain = Matrix3d::Zero();
  strain(m, n) += 0.5;
  strain(n, m) += 0.5;
  const double centre = g(0) * h(0) / mass_;
  const Matrix3d s = Between(g, h) - centre * Matrix3d::Identity();
  Matrix3d change = -2.0 * (strain * s + s * strain + centre * strain);
  // The stress of that strain, on e_m along e_n and the other way round.
  const double stress = stress_(k);
  for (int b = 0; b < 3; ++b) {
    const Matrix3d of_impulse = OfImpulse(h, b);
    Matrix3d moved = -2.0 * strain * of_impulse * moments_.asDiagonal();
    moved.col(m) += stress * of_impulse.col(n);
    if (m != n) moved.col(n) += stress * of_impulse.col(m);
    change.col(b) -= Solve(moved) * g.tail<3>();
  }
  return change;
}

double JointShift(const Structure& structure) {
  double mass = 0.0;
  for (const Structure::Body& body : structure.bodies) {
    mass = std::max(mass, body.body->ancf()->mass());
  }
  return kJointShift / mass;
}

void SetBodyConstants(const Structure& structure, int body, double time_step,
                      double* constants, size_t lane) {
  using C = BodyConstants;
  if (body == BodyJoint::kNone) return;
  const AncfRigidBody& ancf =
      *structure.bodies[static_cast<size_t>(body)].body->ancf();
  const JointCompliance compliance(ancf, time_step);
  PackEntry(constants, C::kMass, lane) = ancf.mass();
  PackEntry(constants, C::kInverseMass, lane) = 1.0 / ancf.mass();
  SetPackVector(ancf.second_moment().diagonal(), constants, C::kMoment, lane);
  for (int k = 0; k < 6; ++k) {
    PackEntry(constants, C::kStiffness + k, lane) = ancf.penalty_stiffness()(k);
    PackEntry(constants, C::kInverse + k, lane) = compliance.inverse()(k);
  }
  SetPackVector(compliance.shear(), constants, C::kShear, lane);
}

void SetJointConstants(const Structure& structure, int body, double time_step,
                       const Vector4d& right, const Vector4d& left,
                       double* constants, size_t lane) {
  using C = BodyConstants;
  if (body == BodyJoint::kNone) return;
  const JointCompliance compliance(
      *structure.bodies[static_cast<size_t>(body)].body->ancf(), time_step);
  for (int a = 0; a < 4; ++a) {
    PackEntry(constants, C::kRightWeight + a, lane) = right(a);
    PackEntry(constants, C::kLeftWeight + a, lane) = left(a);
  }
  SetPackSymmetric(compliance.Between(right, right), constants,
                   C::kRightCompliance, lane);
  SetPackSymmetric(compliance.Between(left, left), constants,
                   C::kLeftCompliance, lane);
  SetPackMatrix(compliance.Between(right, left), constants, C::kCrossCompliance,
                lane);
  for (int k = 0; k < 6; ++k) {
    SetPackSymmetric(compliance.OfStrain(right, right, k), constants,
                     C::kRightStrain + 6 * k, lane);
    SetPackSymmetric(compliance.OfStrain(left, left, k), constants,
                     C::kLeftStrain + 6 * k, lane);
    SetPackMatrix(compliance.OfStrain(right, left, k), constants,
                  C::kCrossStrain + 9 * k, lane);
  }
  for (int axis = 0; axis < 3; ++axis) {
    SetPackVector(Axial(compliance.OfTurn(right, right, axis)), constants,
                  C::kRightTurn + 3 * axis, lane);
    SetPackVector(Axial(compliance.OfTurn(left, left, axis)), constants,
                  C::kLeftTurn + 3 * axis, lane);
    SetPackMatrix(compliance.OfTurn(right, left, axis), constants,
                  C::kCrossTurn + 9 * axis, lane);
  }
}

}  // namespace emmy
