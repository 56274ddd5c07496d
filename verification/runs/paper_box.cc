#include "verification/runs/paper_box.h"

#include "absl/strings/str_format.h"

namespace emmy::verification {
namespace {

constexpr double kDensity = 2700.0;  // [kg/m³]

Vector3d Size() { return {3.0, 2.0, 1.0}; }             // [m]
Vector3d AngularVelocity() { return {0.3, 0.5, 0.8}; }  // [rad/s]

RigidBodyDescription Box() {
  RigidBodyDescription body;
  body.name = "box";
  body.inertia = BoxInertia{.size = Size(), .density = kDensity};
  body.angular_velocity = AngularVelocity();
  return body;
}

ModelDescription WithTruss(ModelDescription model) {
  const Vector3d corner = 0.5 * Size();
  const Vector3d tip(1.5, 1.0, 1.3);
  NodeDescription node;
  node.name = "tip";
  node.position = tip;
  node.velocity = MovesWith{"box"};
  model.nodes.push_back(node);
  TrussDescription truss;
  truss.name = "arm";
  truss.ends = {BodyPoint{"box", corner}, NodePoint{"tip"}};
  truss.area = 1e-4;
  truss.density = kDensity;
  truss.young_modulus = 7e10;
  model.trusses.push_back(truss);
  return model;
}

}  // namespace

ModelDescription PaperBoxAncf(double penalty, Start start) {
  RigidBodyDescription body = Box();
  body.formulation = Formulation::kAncf;
  body.penalty = penalty;
  body.start = start;
  ModelDescription model;
  model.rigid_bodies.push_back(body);
  return model;
}

ModelDescription PaperBoxConventional() {
  RigidBodyDescription body = Box();
  body.formulation = Formulation::kConventional;
  ModelDescription model;
  model.rigid_bodies.push_back(body);
  return model;
}

ModelDescription PaperTrussAncf(double penalty) {
  return WithTruss(PaperBoxAncf(penalty));
}

ModelDescription PaperTrussConventional() {
  return WithTruss(PaperBoxConventional());
}

std::string PenaltyLabel(double penalty) {
  return absl::StrFormat("alpha = %g Pa", penalty);
}

}  // namespace emmy::verification
