#include "emmy/integrate/joint_compliance.h"

#include <algorithm>

#include "emmy/integrate/body_packs.h"
#include "emmy/integrate/joint_chain_kernel.h"
#include "emmy/integrate/joint_graph.h"

namespace emmy {

JointCompliance::JointCompliance(const AncfRigidBody& body, double time_step)
    : mass_(body.mass()), moments_(body.second_moment().diagonal()) {
  const Vector6d c = (0.25 * time_step * time_step) * body.penalty_stiffness();
  shear_ = c.tail<3>();
  for (int i = 0; i < 3; ++i) {
    inverse_(i) = 1.0 / (moments_(i) + c(i));
    const auto [m, n] = AncfRigidBody::kShearPairs[static_cast<size_t>(i)];
    // The determinant without the cancellation of c² − c².
    inverse_(3 + i) = 1.0 / (moments_(m) * moments_(n) +
                             c(3 + i) * (moments_(m) + moments_(n)));
  }
}

Matrix3d JointCompliance::Between(const Vector4d& g, const Vector4d& h) const {
  Matrix3d s = (g(0) * h(0) / mass_) * Matrix3d::Identity();
  for (int i = 0; i < 3; ++i) {
    s(i, i) += inverse_(i) * g(1 + i) * h(1 + i);
    const auto [m, n] = AncfRigidBody::kShearPairs[static_cast<size_t>(i)];
    const double c = shear_(i);
    const double inverse = inverse_(3 + i);
    // The vector of e_m along n, and that of e_n along m.
    s(n, n) += inverse * (moments_(n) + c) * g(1 + m) * h(1 + m);
    s(m, m) += inverse * (moments_(m) + c) * g(1 + n) * h(1 + n);
    s(n, m) -= inverse * c * g(1 + m) * h(1 + n);
    s(m, n) -= inverse * c * g(1 + n) * h(1 + m);
  }
  return s;
}

double JointShift(const Structure& structure) {
  double mass = 0.0;
  for (const Structure::Body& body : structure.bodies) {
    mass = std::max(mass, body.body->ancf()->mass());
  }
  return kJointShift / mass;
}

void SetBodyConstants(const Structure& structure, int body, double time_step,
                      const Vector4d& right, const Vector4d& left,
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
  for (int a = 0; a < 4; ++a) {
    PackEntry(constants, C::kRightWeight + a, lane) = right(a);
    PackEntry(constants, C::kLeftWeight + a, lane) = left(a);
  }
  SetPackSymmetric(compliance.Between(right, right), constants,
                   C::kRightCompliance, lane);
  SetPackSymmetric(compliance.Between(left, left), constants,
                   C::kLeftCompliance, lane);
  const Matrix3d cross = compliance.Between(right, left);
  for (int column = 0; column < 3; ++column) {
    SetPackVector(cross.col(column), constants,
                  C::kCrossCompliance + 3 * column, lane);
  }
}

}  // namespace emmy
