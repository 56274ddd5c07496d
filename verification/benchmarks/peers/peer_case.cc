#include "verification/benchmarks/peers/peer_case.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <string>
#include <variant>

#include "absl/strings/str_cat.h"
#include "emmy/base/check.h"
#include "verification/models/large_models.h"
#include "verification/runs/paper_box.h"

namespace emmy::verification {
namespace {

constexpr double kPenalty = 1e10;  // [Pa]

RigidMotion MotionOf(const RigidBodyDescription& body) {
  const BoxInertia& box = std::get<BoxInertia>(body.inertia);
  const Vector3d squares = box.size.cwiseAbs2();
  RigidMotion motion;
  motion.mass = box.density * box.size.prod();
  motion.inertia = motion.mass / 12.0 *
                   Vector3d(squares(1) + squares(2), squares(2) + squares(0),
                            squares(0) + squares(1));
  motion.position = body.position;
  motion.velocity = body.velocity;
  motion.angular_velocity = body.angular_velocity;
  return motion;
}

struct Bar {
  Vector3d corner;  // Where it starts on the box [m].
  double length = 0.0;
  double mass = 0.0;
  double area = 0.0;
  double stiffness = 0.0;  // EA / L [N/m]
};

// Along +z from the corner of the box.
Bar PaperBar() {
  const ModelDescription model = PaperTrussConventional();
  const TrussDescription& truss = model.trusses.at(0);
  Bar bar;
  bar.corner = std::get<BodyPoint>(truss.ends[0]).point;
  bar.length = (model.nodes.at(0).position - bar.corner).norm();
  bar.area = truss.area;
  bar.mass = truss.density * truss.area * bar.length;
  bar.stiffness = truss.young_modulus * truss.area / bar.length;
  return bar;
}

// A body that starts as if it were part of the box.
RigidMotion CarriedBy(const RigidMotion& box, const Vector3d& position) {
  RigidMotion motion;
  motion.position = position;
  motion.velocity = box.velocity + box.angular_velocity.cross(position);
  return motion;
}

}  // namespace

PeerCase PeerCaseOf(const ModelDescription& description) {
  EMMY_CHECK(description.trusses.empty() && description.nodes.empty() &&
                 description.springs.empty() && description.loads.empty(),
             "bodies and shared points only");
  PeerCase value;
  std::map<std::string, size_t> index;
  for (const RigidBodyDescription& body : description.rigid_bodies) {
    index[body.name] = value.bodies.size();
    value.bodies.push_back(MotionOf(body));
  }
  for (const auto& shared : description.shared_points) {
    PointPair joint;
    for (size_t end = 0; end < 2; ++end) {
      const BodyPoint& point = std::get<BodyPoint>(shared[end]);
      joint.bodies[end] = index.at(point.body);
      joint.points[end] = point.point;
    }
    value.joints.push_back(joint);
  }
  return value;
}

PeerCase PeerBox() { return PeerCaseOf(PaperBoxConventional()); }

PeerCase PeerBoxWithRigidBar() {
  PeerCase value = PeerBox();
  const Bar bar = PaperBar();
  const Vector3d half(0.0, 0.0, 0.5 * bar.length);
  RigidMotion body = CarriedBy(value.bodies[0], bar.corner + half);
  body.mass = bar.mass;
  body.angular_velocity = value.bodies[0].angular_velocity;
  // A round rod: m L² / 12 across, and m r² / 2 along with π r² its section.
  const double across = bar.mass * bar.length * bar.length / 12.0;
  body.inertia = {across, across, 0.5 * bar.mass * bar.area / M_PI};
  value.bodies.push_back(body);
  value.joints.push_back({{0, 1}, {bar.corner, -half}});
  return value;
}

PeerCase PeerBoxWithSpring() {
  PeerCase value = PeerBox();
  const Bar bar = PaperBar();
  RigidMotion tip =
      CarriedBy(value.bodies[0], bar.corner + Vector3d(0.0, 0.0, bar.length));
  tip.mass = 0.5 * bar.mass;
  // Engines ask for an inertia; nothing turns this body, so it does not count.
  tip.inertia = Vector3d::Constant(1e-3 * tip.mass);
  value.bodies.push_back(tip);
  value.springs.push_back(
      {{{0, 1}, {bar.corner, Vector3d::Zero()}}, bar.stiffness, bar.length});
  return value;
}

ModelDescription FreeBoxes(int n, Formulation formulation) {
  ModelDescription model;
  for (int i = 0; i < n; ++i) {
    RigidBodyDescription box;
    box.name = absl::StrCat("box_", i);
    box.inertia = BoxInertia{.size = {3.0, 2.0, 1.0}, .density = 2700.0};
    box.formulation = formulation;
    if (formulation == Formulation::kAncf) box.penalty = kPenalty;
    const int column = i % 10, row = i / 10 % 10, layer = i / 100;
    box.position = 5.0 * Vector3d(column, row, layer);
    box.angular_velocity = {0.3 + 0.1 * std::cos(1.7 * i),
                            0.5 + 0.1 * std::sin(0.9 * i),
                            0.8 + 0.1 * std::cos(1.3 * i)};
    model.rigid_bodies.push_back(box);
  }
  return model;
}

PeerCase PeerFreeBoxes(int n) {
  return PeerCaseOf(FreeBoxes(n, Formulation::kConventional));
}

PeerCase PeerChain(int n) { return PeerCaseOf(BoxChain(n).model); }

}  // namespace emmy::verification
