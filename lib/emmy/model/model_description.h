// What a model is, as a person states it: names, sizes, densities, points.
//
// Plain data without invariants. `BuildModel` (model_builder.h) checks it and
// is the only place that does. The fields mirror the case format, and messages
// name a field by its JSON pointer (`/rigid_bodies/0/box/density`), so that
// the same message serves a file and a program.
//
// SI units; "inertial" is the fixed frame, "body" the frame of the body with
// origin at the centre of mass.

#ifndef EMMY_MODEL_MODEL_DESCRIPTION_H_
#define EMMY_MODEL_MODEL_DESCRIPTION_H_

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "emmy/base/types.h"

namespace emmy {

// How a rigid body is described by coordinates.
enum class Formulation {
  kAncf,          // Centre of mass and three gradient vectors, with penalty.
  kConventional,  // Centre of mass and finite rotation.
};

// Where the strain of an ANCF body starts.
enum class Start {
  kUndeformed,  // All strains zero.
  kRelaxed,     // The strain that balances the rigid-body acceleration.
};

// A homogeneous box with edges along the body axes.
struct BoxInertia {
  Vector3d size = Vector3d::Zero();  // Edge lengths [m], > 0.
  double density = 0.0;              // [kg/m^3], > 0.
};

// Any inertia, given about the centre of mass in body axes.
struct TensorInertia {
  double mass = 0.0;                   // [kg], > 0.
  Matrix3d tensor = Matrix3d::Zero();  // J [kg m^2], symmetric.
  double volume = 0.0;                 // [m^3], > 0; scales the penalty.
};

// w + x i + y j + z k, not zero; BuildModel normalises it.
struct Quaternion {
  double w = 1.0;
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

// An orientation by one turn from the inertial axes.
struct RotationVector {
  Vector3d vector = Vector3d::Zero();  // Axis times angle [rad].
};

// A rigid body, in either formulation, and how it starts.
struct RigidBodyDescription {
  std::string name;
  Formulation formulation = Formulation::kAncf;
  std::variant<BoxInertia, TensorInertia> inertia;
  // One coefficient for all strains or six in the order of (ANCF-4) [Pa];
  // required for kAncf, not allowed for kConventional.
  std::variant<std::monostate, double, std::array<double, 6>> penalty;
  Vector3d position = Vector3d::Zero();  // Centre of mass [m].
  std::variant<Quaternion, RotationVector> orientation;
  Vector3d velocity = Vector3d::Zero();          // Centre of mass [m/s].
  Vector3d angular_velocity = Vector3d::Zero();  // [rad/s]
  bool angular_velocity_in_body_axes = false;    // Else inertial.
  Start start = Start::kUndeformed;
};

// A point fixed in a body.
struct BodyPoint {
  std::string body;
  Vector3d point = Vector3d::Zero();  // ξ in body axes [m].
};
// A node, by its name.
struct NodePoint {
  std::string node;
};
// A point fixed in space.
struct GroundPoint {
  Vector3d position = Vector3d::Zero();  // [m]
};

// Any of these points.
using PointDescription = std::variant<BodyPoint, NodePoint, GroundPoint>;

// The node starts with the velocity of the body's material point there.
struct MovesWith {
  std::string body;
};

// A point with its own mass, or none.
struct NodeDescription {
  std::string name;
  double mass = 0.0;                     // [kg], >= 0.
  Vector3d position = Vector3d::Zero();  // [m]
  std::variant<Vector3d, MovesWith> velocity =
      Vector3d(0.0, 0.0, 0.0);  // [m/s]
  bool fixed = false;
};

// A truss or cable between two points.
struct TrussDescription {
  std::string name;
  std::array<PointDescription, 2> ends;
  double area = 0.0;             // [m^2], > 0.
  double density = 0.0;          // [kg/m^3], >= 0.
  double young_modulus = 0.0;    // [Pa], > 0.
  bool tension_only = false;     // A cable: no force in compression.
  std::optional<double> length;  // Natural length [m]; else the initial one.
};

// A linear spring between two points.
struct SpringDescription {
  std::string name;
  std::array<PointDescription, 2> ends;
  double stiffness = 0.0;  // [N/m], > 0.
  double length = 0.0;     // Natural length [m], >= 0.
};

// A force at a point.
struct ForceLoad {
  PointDescription point;
  Vector3d force = Vector3d::Zero();  // Constant, inertial [N].
};
// A torque on a body.
struct TorqueLoad {
  std::string body;
  Vector3d torque = Vector3d::Zero();  // Constant, inertial [N m].
};

struct ModelDescription {
  Vector3d gravity = Vector3d::Zero();  // [m/s^2]
  std::vector<RigidBodyDescription> rigid_bodies;
  std::vector<NodeDescription> nodes;
  std::vector<TrussDescription> trusses;
  std::vector<SpringDescription> springs;
  std::vector<std::array<PointDescription, 2>> shared_points;
  std::vector<std::variant<ForceLoad, TorqueLoad>> loads;
};

}  // namespace emmy

#endif  // EMMY_MODEL_MODEL_DESCRIPTION_H_
