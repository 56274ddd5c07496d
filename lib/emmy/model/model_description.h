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

// w + x i + y j + z k, not zero; BuildModel normalises it. Turns body axes
// into inertial ones.
struct Quaternion {
  double w = 1.0;  // The cosine of half the angle.
  double x = 0.0;  // Of i: inertial x.
  double y = 0.0;  // Of j: inertial y.
  double z = 0.0;  // Of k: inertial z.
};

// An orientation by one turn from the inertial axes.
struct RotationVector {
  Vector3d vector = Vector3d::Zero();  // Axis times angle [rad].
};

// A rigid body, in either formulation, and how it starts.
struct RigidBodyDescription {
  std::string name;  // Of no other body, node, truss or spring.
  Formulation formulation = Formulation::kAncf;     // Which coordinates.
  std::variant<BoxInertia, TensorInertia> inertia;  // Mass and moments.
  // One coefficient for all strains or six in the order of (ANCF-4) [Pa];
  // required for kAncf, not allowed for kConventional.
  std::variant<std::monostate, double, std::array<double, 6>> penalty;
  Vector3d position = Vector3d::Zero();  // Centre of mass [m].
  // Of the body axes at the start; unturned if not given.
  std::variant<Quaternion, RotationVector> orientation;
  Vector3d velocity = Vector3d::Zero();          // Centre of mass [m/s].
  Vector3d angular_velocity = Vector3d::Zero();  // [rad/s]
  bool angular_velocity_in_body_axes = false;    // Else inertial.
  Start start = Start::kUndeformed;              // Of an ANCF body.
};

// A point fixed in a body.
struct BodyPoint {
  std::string body;                   // Name.
  Vector3d point = Vector3d::Zero();  // ξ in body axes [m].
};
// A node, by its name.
struct NodePoint {
  std::string node;  // Name.
};
// A point fixed in space.
struct GroundPoint {
  Vector3d position = Vector3d::Zero();  // Inertial [m].
};

// Any of these points.
using PointDescription = std::variant<BodyPoint, NodePoint, GroundPoint>;

// The node starts with the velocity of the body's material point there.
struct MovesWith {
  std::string body;  // Name.
};

// A point with its own mass, or none.
struct NodeDescription {
  std::string name;                      // Of no other item, as of bodies.
  double mass = 0.0;                     // [kg], >= 0.
  Vector3d position = Vector3d::Zero();  // At the start, inertial [m].
  std::variant<Vector3d, MovesWith> velocity =
      Vector3d(0.0, 0.0, 0.0);  // At the start, inertial [m/s].
  bool fixed = false;           // In space, from the start on.
};

// A truss or cable between two points.
struct TrussDescription {
  std::string name;                      // Of no other item, as of bodies.
  std::array<PointDescription, 2> ends;  // From the first to the second.
  double area = 0.0;                     // [m^2], > 0.
  double density = 0.0;                  // [kg/m^3], >= 0.
  double young_modulus = 0.0;            // [Pa], > 0.
  bool tension_only = false;             // A cable: no force in compression.
  std::optional<double> length;  // Natural length [m]; else the initial one.
};

// A linear spring between two points.
struct SpringDescription {
  std::string name;                      // Of no other item, as of bodies.
  std::array<PointDescription, 2> ends;  // From the first to the second.
  double stiffness = 0.0;                // [N/m], > 0.
  double length = 0.0;                   // Natural length [m], >= 0.
};

// A force at a point.
struct ForceLoad {
  PointDescription point;             // Where it acts, for good.
  Vector3d force = Vector3d::Zero();  // Constant, inertial [N].
};
// A torque on a body.
struct TorqueLoad {
  std::string body;                    // Name.
  Vector3d torque = Vector3d::Zero();  // Constant, inertial [N m].
};

// A whole model.
struct ModelDescription {
  Vector3d gravity = Vector3d::Zero();             // Inertial [m/s^2].
  std::vector<RigidBodyDescription> rigid_bodies;  // At least a body or node.
  std::vector<NodeDescription> nodes;              // Points with a name.
  std::vector<TrussDescription> trusses;           // Trusses and cables.
  std::vector<SpringDescription> springs;          // By true distance.
  // Pairs of points that coincide at the start and stay together.
  std::vector<std::array<PointDescription, 2>> shared_points;
  std::vector<std::variant<ForceLoad, TorqueLoad>> loads;  // Constant.
};

}  // namespace emmy

#endif  // EMMY_MODEL_MODEL_DESCRIPTION_H_
