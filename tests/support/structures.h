// Small structures that have every kind of part.

#ifndef EMMY_TESTS_SUPPORT_STRUCTURES_H_
#define EMMY_TESTS_SUPPORT_STRUCTURES_H_

#include <Eigen/Geometry>
#include <string>

#include "emmy/model/model_description.h"
#include "tests/support/paper_box.h"

namespace emmy {

inline NodeDescription TestNode(const std::string& name, double mass,
                                const Vector3d& position,
                                const Vector3d& velocity = {0.0, 0.0, 0.0}) {
  NodeDescription node;
  node.name = name;
  node.mass = mass;
  node.position = position;
  node.velocity = velocity;
  return node;
}

// EA = 7 MN, 0.27 kg/m.
inline TrussDescription TestTruss(const std::string& name,
                                  const PointDescription& first,
                                  const PointDescription& second) {
  TrussDescription truss;
  truss.name = name;
  truss.ends = {first, second};
  truss.area = 1e-4;
  truss.density = 2700.0;
  truss.young_modulus = 7e10;
  return truss;
}

// The paper's box with a truss on one corner (5.2).
inline ModelDescription BoxWithTruss(
    Formulation formulation = Formulation::kAncf, double penalty = 1e10) {
  ModelDescription model = ModelOf(PaperBox(formulation, penalty));
  NodeDescription tip = TestNode("tip", 0.0, {1.5, 1.0, 1.3});
  tip.velocity = MovesWith{"box"};
  model.nodes.push_back(tip);
  model.trusses.push_back(
      TestTruss("arm", BodyPoint{"box", {1.5, 1.0, 0.5}}, NodePoint{"tip"}));
  return model;
}

// Two boxes joined by a ball, a third on a cable and a spring with two nodes:
// in mid-air, everything moving.
inline ModelDescription Tangle() {
  RigidBodyDescription left = PaperBox();
  RigidBodyDescription right = PaperBox();
  right.name = "right";
  right.position = {3.0, 0.0, 0.0};
  right.angular_velocity = {-0.2, 0.4, 0.6};
  const Vector3d arm(1.5, 0.0, 0.0);
  right.velocity =
      left.angular_velocity.cross(arm) + right.angular_velocity.cross(arm);
  RigidBodyDescription third = PaperBox();
  third.name = "third";
  third.position = {0.0, 5.0, 0.0};
  third.velocity = {0.1, 0.8, -0.3};
  ModelDescription model = ModelOf(left);
  model.rigid_bodies.push_back(right);
  model.rigid_bodies.push_back(third);
  model.shared_points.push_back(
      {BodyPoint{"box", arm}, BodyPoint{"right", -arm}});
  model.nodes = {TestNode("a", 30.0, {0.0, 2.5, 0.5}, {0.0, 1.0, 0.0}),
                 TestNode("b", 20.0, {3.0, 2.5, 0.5}, {0.5, 0.0, 1.0})};
  TrussDescription cable =
      TestTruss("cable", BodyPoint{"third", {0, -1, 0}}, NodePoint{"a"});
  cable.tension_only = true;
  model.trusses = {
      TestTruss("ab", NodePoint{"a"}, NodePoint{"b"}),
      TestTruss("up", BodyPoint{"box", {0, 1, 0.5}}, NodePoint{"a"}), cable};
  model.springs.push_back(
      {"spring", {BodyPoint{"right", {0, 1, 0.5}}, NodePoint{"b"}}, 2e4, 1.0});
  return model;
}

}  // namespace emmy

#endif  // EMMY_TESTS_SUPPORT_STRUCTURES_H_
