#include "emmy/io/finite_start.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "emmy/diagnostics/structure_motion.h"
#include "emmy/io/case_file.h"
#include "emmy/model/model_builder.h"
#include "emmy/model/validation.h"

namespace emmy {
namespace {

std::string VectorText(const Vector3d& vector) {
  return absl::StrCat("[", NumberText(vector(0)), ", ", NumberText(vector(1)),
                      ", ", NumberText(vector(2)), "]");
}

// Whether a part of the model, alone, has a start that is not finite. What is
// no model alone is not at fault.
bool Overflows(const ModelDescription& part) {
  const absl::StatusOr<BuiltModel> built = BuildModel(part);
  return built.ok() && !IsFinite(MeasureInvariants(built->model, built->state));
}

absl::Status TooLarge(const std::string& place, const char* consequence,
                      const std::string& value) {
  return FieldError(place, absl::StrCat("so small that ", consequence), value);
}

constexpr char kKineticEnergy[] =
    "kinetic energy [J] and momentum [kg m/s] are finite numbers";
constexpr char kAngularMomentum[] =
    "the angular momentum [kg m^2/s] is a finite number";
constexpr char kGravityEnergy[] = "the gravity energy [J] is a finite number";

// Moves what is at the origin in `part`, as far as `place`, with gravity after
// that.
absl::Status CheckPosition(const std::string& pointer, const Vector3d& position,
                           const Vector3d& gravity, Vector3d* place,
                           ModelDescription* part) {
  const std::string text = VectorText(position) + " m";
  *place = position;
  if (Overflows(*part)) {
    return TooLarge(pointer + "/position", kAngularMomentum, text);
  }
  part->gravity = gravity;
  if (!Overflows(*part)) return absl::OkStatus();
  return TooLarge(pointer + "/position", kGravityEnergy, text);
}

// Adds one field after the other to a body at rest at the origin.
absl::Status CheckBody(const std::string& pointer, const Vector3d& gravity,
                       const RigidBodyDescription& body) {
  ModelDescription part;
  part.rigid_bodies = {body};
  RigidBodyDescription& moved = part.rigid_bodies[0];
  moved.position.setZero();
  moved.angular_velocity.setZero();
  if (Overflows(part)) {
    return TooLarge(pointer + "/velocity", kKineticEnergy,
                    VectorText(body.velocity) + " m/s");
  }
  moved.angular_velocity = body.angular_velocity;
  if (Overflows(part)) {
    return TooLarge(
        pointer + (body.angular_velocity_in_body_axes ? "/angular_velocity_body"
                                                      : "/angular_velocity"),
        kKineticEnergy, VectorText(body.angular_velocity) + " rad/s");
  }
  return CheckPosition(pointer, body.position, gravity, &moved.position, &part);
}

absl::Status CheckNode(const std::string& pointer, const Vector3d& gravity,
                       const NodeDescription& node, const Vector3d& velocity) {
  if (node.fixed || node.mass == 0.0) return absl::OkStatus();
  ModelDescription part;
  part.nodes = {{.name = node.name, .mass = node.mass, .velocity = velocity}};
  if (Overflows(part)) {
    return TooLarge(pointer + "/velocity", kKineticEnergy,
                    VectorText(velocity) + " m/s");
  }
  return CheckPosition(pointer, node.position, gravity, &part.nodes[0].position,
                       &part);
}

// What the mass of a line contributes to energy and momenta at the start.
absl::Status CheckLineMass(const std::string& pointer, const Model& model,
                           const State& state, const ModelLine& line) {
  // The products and sums of double-double arithmetic overflow before doubles.
  constexpr double kNearOverflow = 1e290;
  double distance = 0.0;
  double speed = 0.0;
  for (const Point& end : line.ends) {
    const PointMotion motion = ObservePoint(model, state, end);
    distance = std::max(distance, motion.position.stableNorm());
    speed = std::max(speed, motion.velocity.stableNorm());
  }
  const double gravity = model.gravity().stableNorm();
  const double largest = line.mass * std::max({speed * speed, distance * speed,
                                               speed, distance * gravity});
  if (largest <= kNearOverflow) return absl::OkStatus();
  return FieldError(
      pointer,
      "a truss whose energy [J], momentum [kg m/s] and angular momentum "
      "[kg m^2/s] at the start are finite numbers",
      absl::StrCat("a mass of ", NumberText(line.mass), " kg, with an end ",
                   NumberText(distance),
                   " m from the origin and one that moves "
                   "at ",
                   NumberText(speed), " m/s"));
}

absl::Status CheckLine(const std::string& pointer, const Model& model,
                       const State& state, const ModelLine& line) {
  const bool is_spring = line.element.kind() == LineElement::Kind::kSpring;
  if (!std::isfinite(line.element.stiffness())) {
    return FieldError(pointer, "a truss of finite stiffness E A [N]",
                      NumberText(line.element.stiffness()) + " N");
  }
  const DoubleDouble strain(state.strain.value(line.strain_offset),
                            state.strain.compensation(line.strain_offset));
  if (std::isfinite(line.element.Energy(strain).ToDouble())) {
    return CheckLineMass(pointer, model, state, line);
  }
  return FieldError(
      pointer,
      absl::StrCat("a ", is_spring ? "spring" : "truss",
                   " whose energy at the start is a finite number [J]"),
      absl::StrCat(
          "a strain of ", NumberText(line.element.Strain(strain.ToDouble())),
          " and a ", is_spring ? "stiffness of " : "stiffness E A of ",
          NumberText(line.element.stiffness()), is_spring ? " N/m" : " N"));
}

}  // namespace

absl::Status CheckFiniteStart(const ModelDescription& description,
                              const Model& model, const State& state) {
  if (IsFinite(MeasureInvariants(model, state))) return absl::OkStatus();
  const Vector3d& gravity = description.gravity;
  absl::Status status;
  for (size_t i = 0; status.ok() && i < model.bodies().size(); ++i) {
    status = CheckBody(absl::StrCat("/rigid_bodies/", i), gravity,
                       description.rigid_bodies[i]);
  }
  for (size_t i = 0; status.ok() && i < model.nodes().size(); ++i) {
    status =
        CheckNode(absl::StrCat("/nodes/", i), gravity, description.nodes[i],
                  ObserveNode(model, state, i).velocity);
  }
  const size_t num_trusses = description.trusses.size();
  for (size_t i = 0; status.ok() && i < model.lines().size(); ++i) {
    status =
        CheckLine(i < num_trusses ? absl::StrCat("/trusses/", i)
                                  : absl::StrCat("/springs/", i - num_trusses),
                  model, state, model.lines()[i]);
  }
  if (!status.ok()) return status;
  return absl::InvalidArgumentError(
      "energy and momentum at the start must be finite numbers: a mass, "
      "length, stiffness or velocity is too large");
}

}  // namespace emmy
