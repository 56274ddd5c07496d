#include "emmy/io/case_reader.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <variant>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"
#include "emmy/io/case_keys.h"
#include "emmy/io/json_reader.h"

namespace emmy {
namespace {

constexpr char kName[] = "a name that is not empty";

bool IsPositive(double x) { return std::isfinite(x) && x > 0.0; }

std::variant<BoxInertia, TensorInertia> ReadInertia(const JsonReader& body) {
  if (body.ExactlyOneOf({"box", "inertia"}) == "box") {
    const JsonReader in = body["box"];
    in.ExpectKeys(kBoxKeys);
    BoxInertia box;
    in["size"].Numbers("three finite numbers > 0 [m]",
                       "a finite number > 0 [m]", 3, box.size.data());
    box.density = in["density"].Number("a finite number > 0 [kg/m^3]");
    return box;
  }
  const JsonReader in = body["inertia"];
  in.ExpectKeys(kInertiaKeys);
  TensorInertia inertia;
  inertia.mass = in["mass"].Number("a finite number > 0 [kg]");
  inertia.volume = in["volume"].Number("a finite number > 0 [m^3]");

  constexpr char kTensor[] = "[Jx, Jy, Jz] or a symmetric 3x3 matrix [kg m^2]";
  const JsonReader tensor = in["tensor"];
  if (tensor.is_array() && tensor.size() == 3 && tensor.Element(0).is_array()) {
    for (int row = 0; row < 3; ++row) {
      inertia.tensor.row(row) =
          tensor.Element(static_cast<size_t>(row)).Vector("kg m^2");
    }
  } else {
    Vector3d diagonal = Vector3d::Zero();
    tensor.Numbers(kTensor, "a finite number > 0 [kg m^2]", 3, diagonal.data());
    inertia.tensor = diagonal.asDiagonal();
  }
  return inertia;
}

std::variant<std::monostate, double, std::array<double, 6>> ReadPenalty(
    const JsonReader& in) {
  constexpr char kPenalty[] = "a finite number > 0 or six of them [Pa]";
  if (!in.is_array()) return in.Number(kPenalty);
  std::array<double, 6> six = {};
  in.Numbers(kPenalty, "a finite number > 0 [Pa]", six.size(), six.data());
  return six;
}

std::variant<Quaternion, RotationVector> ReadOrientation(const JsonReader& in) {
  in.ExpectKeys(kOrientationKeys);
  if (in.ExactlyOneOf({"quaternion", "rotation_vector"}) == "quaternion") {
    std::array<double, 4> q = {};
    in["quaternion"].Numbers("four finite numbers [w, x, y, z], not all zero",
                             "a finite number", q.size(), q.data());
    return Quaternion{q[0], q[1], q[2], q[3]};
  }
  return RotationVector{in["rotation_vector"].Vector("rad")};
}

RigidBodyDescription ReadRigidBody(const JsonReader& in) {
  in.ExpectKeys(kRigidBodyKeys);
  RigidBodyDescription body;
  body.name = in["name"].String(kName);
  if (in.Has("formulation")) {
    const std::string name =
        in["formulation"].String("\"ancf\" or \"conventional\"");
    if (name == "conventional") {
      body.formulation = Formulation::kConventional;
    } else if (name != "ancf") {
      in["formulation"].Fail("\"ancf\" or \"conventional\"");
    }
  }
  body.inertia = ReadInertia(in);
  if (in.Has("penalty")) body.penalty = ReadPenalty(in["penalty"]);
  if (in.Has("position")) body.position = in["position"].Vector("m");
  if (in.Has("orientation")) {
    body.orientation = ReadOrientation(in["orientation"]);
  }
  if (in.Has("velocity")) body.velocity = in["velocity"].Vector("m/s");
  const absl::string_view angular_velocity =
      in.AtMostOneOf({"angular_velocity", "angular_velocity_body"});
  if (!angular_velocity.empty()) {
    body.angular_velocity = in[angular_velocity].Vector("rad/s");
    body.angular_velocity_in_body_axes =
        angular_velocity == "angular_velocity_body";
  }
  if (in.Has("start")) {
    const std::string name =
        in["start"].String("\"undeformed\" or \"relaxed\"");
    if (name == "relaxed") {
      body.start = Start::kRelaxed;
    } else if (name != "undeformed") {
      in["start"].Fail("\"undeformed\" or \"relaxed\"");
    }
  }
  return body;
}

PointDescription ReadPoint(const JsonReader& in) {
  if (in.Has("body") + in.Has("node") + in.Has("ground") != 1) {
    in.ExpectKeys(kPointKeys);
    in.ExactlyOneOf({"body", "node", "ground"});
  }
  if (in.Has("node")) {
    in.ExpectKeys(kNodePointKeys);
    return NodePoint{in["node"].String("the name of a node")};
  }
  if (in.Has("ground")) {
    in.ExpectKeys(kGroundPointKeys);
    return GroundPoint{in["ground"].Vector("m")};
  }
  in.ExpectKeys(kBodyPointKeys);
  return BodyPoint{in["body"].String("the name of a rigid body"),
                   in["point"].Vector("m")};
}

std::array<PointDescription, 2> ReadTwoPoints(const JsonReader& in) {
  if (!in.is_array() || in.size() != 2) {
    in.Fail("an array of two points");
    return {};
  }
  return {ReadPoint(in.Element(0)), ReadPoint(in.Element(1))};
}

NodeDescription ReadNode(const JsonReader& in) {
  in.ExpectKeys(kNodeKeys);
  NodeDescription node;
  node.name = in["name"].String(kName);
  node.mass = in["mass"].Number("a finite number >= 0 [kg]");
  if (in.Has("position")) node.position = in["position"].Vector("m");
  if (in.Has("velocity")) {
    const JsonReader velocity = in["velocity"];
    if (velocity.is_object()) {
      velocity.ExpectKeys(kMovesWithKeys);
      node.velocity =
          MovesWith{velocity["moves_with"].String("the name of a rigid body")};
    } else {
      Vector3d vector = Vector3d::Zero();
      velocity.Numbers("three finite numbers [m/s] or {\"moves_with\": BODY}",
                       "a finite number [m/s]", 3, vector.data());
      node.velocity = vector;
    }
  }
  if (in.Has("fixed")) node.fixed = in["fixed"].Boolean();
  return node;
}

TrussDescription ReadTruss(const JsonReader& in) {
  in.ExpectKeys(kTrussKeys);
  TrussDescription truss;
  truss.name = in["name"].String(kName);
  truss.ends = ReadTwoPoints(in["ends"]);
  truss.area = in["area"].Number("a finite number > 0 [m^2]");
  truss.density = in["density"].Number("a finite number >= 0 [kg/m^3]");
  truss.young_modulus = in["young_modulus"].Number("a finite number > 0 [Pa]");
  if (in.Has("length")) {
    truss.length = in["length"].Number("a finite number > 0 [m]");
  }
  if (in.Has("tension_only")) truss.tension_only = in["tension_only"].Boolean();
  return truss;
}

SpringDescription ReadSpring(const JsonReader& in) {
  in.ExpectKeys(kSpringKeys);
  SpringDescription spring;
  spring.name = in["name"].String(kName);
  spring.ends = ReadTwoPoints(in["ends"]);
  spring.stiffness = in["stiffness"].Number("a finite number > 0 [N/m]");
  spring.length = in["length"].Number("a finite number >= 0 [m]");
  return spring;
}

std::variant<ForceLoad, TorqueLoad> ReadLoad(const JsonReader& in) {
  if (in.Has("force") + in.Has("torque") != 1) {
    in.ExpectKeys(kLoadKeys);
    in.ExactlyOneOf({"force", "torque"});
  }
  if (in.Has("torque")) {
    in.ExpectKeys(kTorqueKeys);
    return TorqueLoad{in["body"].String("the name of a rigid body"),
                      in["torque"].Vector("N m")};
  }
  in.ExpectKeys(kForceKeys);
  return ForceLoad{ReadPoint(in["point"]), in["force"].Vector("N")};
}

ModelDescription ReadModel(const JsonReader& in) {
  ModelDescription model;
  if (in.Has("gravity")) model.gravity = in["gravity"].Vector("m/s^2");
  // Reads the list `key`, if there is one, with `read` per element.
  const auto read_list = [&in](absl::string_view key, auto read, auto* out) {
    if (!in.Has(key)) return;
    in[key].ForEach("an array", [&](const JsonReader& element) {
      out->push_back(read(element));
    });
  };
  read_list("rigid_bodies", ReadRigidBody, &model.rigid_bodies);
  read_list("nodes", ReadNode, &model.nodes);
  read_list("trusses", ReadTruss, &model.trusses);
  read_list("springs", ReadSpring, &model.springs);
  read_list("shared_points", ReadTwoPoints, &model.shared_points);
  read_list("loads", ReadLoad, &model.loads);
  return model;
}

std::optional<double> ReadTolerance(const JsonReader& in) {
  constexpr char kTolerance[] =
      "\"round_off\" or a relative number in (0, 1) [-]";
  if (in.is_string()) {
    if (in.String(kTolerance) != "round_off") in.Fail(kTolerance);
    return std::nullopt;
  }
  const double tolerance = in.Number(kTolerance);
  if (!(tolerance > 0.0 && tolerance < 1.0)) in.Fail(kTolerance);
  return tolerance;
}

IntegratorSettings ReadIntegrator(const JsonReader& in) {
  in.ExpectKeys(kIntegratorKeys);
  IntegratorSettings settings;
  if (in["method"].String("\"energy_momentum\"") != "energy_momentum") {
    in["method"].Fail("\"energy_momentum\"");
  }
  if (in.Has("order")) {
    const int64_t order = in["order"].Integer("2, 4 or 6");
    if (order != 2 && order != 4 && order != 6) in["order"].Fail("2, 4 or 6");
    settings.order = static_cast<int>(order);
  }
  constexpr char kPositiveTime[] = "a finite number > 0 [s]";
  settings.time_step = in["time_step"].Number(kPositiveTime);
  if (!IsPositive(settings.time_step)) in["time_step"].Fail(kPositiveTime);
  settings.duration = in["duration"].Number(kPositiveTime);
  if (!IsPositive(settings.duration)) in["duration"].Fail(kPositiveTime);
  if (!(settings.duration / settings.time_step <= kMaxSteps)) {
    in["duration"].Fail("at most 2^53 time steps");
  }
  if (in.Has("tolerance")) settings.tolerance = ReadTolerance(in["tolerance"]);
  return settings;
}

int64_t ReadOutputEvery(const JsonReader& in) {
  in.ExpectKeys(kOutputKeys);
  if (!in.Has("every")) return 1;
  constexpr char kSteps[] = "a whole number >= 1 [steps]";
  const int64_t every = in["every"].Integer(kSteps);
  if (every < 1) in["every"].Fail(kSteps);
  return every;
}

}  // namespace

absl::StatusOr<Case> CaseFromJson(const nlohmann::json& json) {
  absl::Status status;
  const JsonReader in(json, "", &status);
  // First, so that a file of another format is called that.
  const std::string format = absl::StrCat("\"", kCaseFormat, "\"");
  if (in.Has("format") && json["format"] != kCaseFormat) {
    in["format"].Fail(format);
  }
  in.ExpectKeys(kCaseKeys);
  Case result;
  result.name = in["name"].String(kName);
  if (result.name.empty()) in["name"].Fail(kName);
  if (in.Has("purpose")) result.purpose = in["purpose"].String("a string");
  result.model = ReadModel(in);
  result.integrator = ReadIntegrator(in["integrator"]);
  if (in.Has("output")) result.output_every = ReadOutputEvery(in["output"]);
  if (!status.ok()) return status;
  return result;
}

}  // namespace emmy
