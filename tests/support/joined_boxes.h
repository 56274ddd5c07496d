// Boxes joined at shared points: chains, hinges and closed linkages.

#ifndef EMMY_TESTS_SUPPORT_JOINED_BOXES_H_
#define EMMY_TESTS_SUPPORT_JOINED_BOXES_H_

#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

#include "emmy/model/model_description.h"
#include "tests/support/paper_box.h"
#include "verification/models/large_models.h"

namespace emmy {

// The same of conventional bodies.
inline ModelDescription Conventional(ModelDescription model) {
  for (RigidBodyDescription& body : model.rigid_bodies) {
    body.formulation = Formulation::kConventional;
    body.penalty = std::monostate();
  }
  return model;
}

// The ends of the chain's first and last box held where they are, at rest.
inline ModelDescription HangingChain(int n, bool both_ends) {
  ModelDescription model = verification::BoxChain(n).model;
  for (RigidBodyDescription& box : model.rigid_bodies) {
    box.velocity.setZero();
    box.angular_velocity.setZero();
  }
  model.gravity = {0.0, 0.3, -9.81};
  const RigidBodyDescription& first = model.rigid_bodies.front();
  const RigidBodyDescription& last = model.rigid_bodies.back();
  model.shared_points.push_back(
      {GroundPoint{first.position - Vector3d(1.5, 0.0, 0.0)},
       BodyPoint{first.name, {-1.5, 0.0, 0.0}}});
  if (both_ends) {
    model.shared_points.push_back(
        {GroundPoint{last.position + Vector3d(1.5, 0.0, 0.0)},
         BodyPoint{last.name, {1.5, 0.0, 0.0}}});
  }
  return model;
}

// With gravity, a torque and a force; for models with three boxes.
inline ModelDescription Loaded(ModelDescription model) {
  model.gravity = {0.1, -0.2, -9.81};
  model.loads.push_back(TorqueLoad{"box_1", {300.0, -200.0, 100.0}});
  model.loads.push_back(
      ForceLoad{BodyPoint{"box_2", {0.3, 0.2, 0.1}}, {200.0, -100.0, 50.0}});
  return model;
}

// Boxes joined in pairs by two points: hinges about the z axis.
inline ModelDescription Hinges(int n) {
  ModelDescription model;
  Vector3d velocity(0.1, 0.2, 0.3);
  double before = 0.0;
  for (int i = 0; i < n; ++i) {
    RigidBodyDescription box = PaperBox();
    box.name = "box_" + std::to_string(i);
    box.position = {3.0 * i, 0.0, 0.0};
    const double omega = 0.3 + 0.2 * (i % 2);
    const Vector3d arm(1.5, 0.0, 0.0);
    if (i > 0) {
      velocity += Vector3d(0.0, 0.0, before + omega).cross(arm);
      for (const double z : {-0.5, 0.5}) {
        model.shared_points.push_back(
            {BodyPoint{"box_" + std::to_string(i - 1), {1.5, 0.0, z}},
             BodyPoint{box.name, {-1.5, 0.0, z}}});
      }
    }
    box.velocity = velocity;
    box.angular_velocity = {0.0, 0.0, omega};
    before = omega;
    model.rigid_bodies.push_back(box);
  }
  return model;
}

// Four boxes in a closed square that shears into a rhombus, joined at its
// corners by spherical joints, or by hinges about z. They overlap: there is no
// contact.
inline ModelDescription BoxRhombus(bool hinged) {
  constexpr double kHalf = 1.5;
  const std::array<Vector3d, 4> centres = {
      {{kHalf, 0, 0}, {0, kHalf, 0}, {-kHalf, 0, 0}, {0, -kHalf, 0}}};
  const std::array<Vector3d, 4> corners = {{{kHalf, kHalf, 0},
                                            {-kHalf, kHalf, 0},
                                            {-kHalf, -kHalf, 0},
                                            {kHalf, -kHalf, 0}}};
  const Vector3d turn =
      hinged ? Vector3d(0.0, 0.0, 0.5) : Vector3d(0.2, -0.1, 0.5);
  ModelDescription model;
  for (size_t i = 0; i < 4; ++i) {
    RigidBodyDescription box = PaperBox();
    box.name = "box_" + std::to_string(i);
    box.position = centres[i];
    // Opposite sides turn alike, neighbours against each other.
    constexpr double kShear = 0.4;
    box.velocity = Vector3d(0.1, 0.2, 0.3) + turn.cross(centres[i]) -
                   kShear * Vector3d(centres[i](1), centres[i](0), 0.0);
    box.angular_velocity =
        turn + Vector3d(0.0, 0.0, i % 2 == 0 ? kShear : -kShear);
    model.rigid_bodies.push_back(box);
    const size_t next = (i + 1) % 4;
    for (const double z :
         hinged ? std::vector<double>{-0.5, 0.5} : std::vector<double>{0.0}) {
      const Vector3d pin = corners[i] + Vector3d(0.0, 0.0, z);
      model.shared_points.push_back(
          {BodyPoint{box.name, pin - centres[i]},
           BodyPoint{"box_" + std::to_string(next), pin - centres[next]}});
    }
  }
  return model;
}

// A kind of such models, as the parameter of a test.
struct JointKind {
  const char* name;
  std::function<ModelDescription()> model;
  bool is_free = true;  // Not held by the ground, and without load.
  friend void PrintTo(const JointKind& kind, std::ostream* os) {
    *os << kind.name;
  }
};

}  // namespace emmy

#endif  // EMMY_TESTS_SUPPORT_JOINED_BOXES_H_
