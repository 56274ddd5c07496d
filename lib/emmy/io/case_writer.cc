#include "emmy/io/case_writer.h"

#include <array>
#include <nlohmann/json.hpp>
#include <variant>
#include <vector>

#include "emmy/io/case_reader.h"
#include "emmy/io/json_text.h"

namespace emmy {
namespace {

using OrderedJson = nlohmann::ordered_json;  // Keys in the order of the format.

// One function for each alternative of a variant.
template <typename... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <typename... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

OrderedJson ToJson(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

OrderedJson ToJson(const Matrix3d& m) {
  return {ToJson(Vector3d(m.row(0))), ToJson(Vector3d(m.row(1))),
          ToJson(Vector3d(m.row(2)))};
}

OrderedJson ToJson(const PointDescription& point) {
  return std::visit(
      Overloaded{[](const BodyPoint& p) -> OrderedJson {
                   return {{"body", p.body}, {"point", ToJson(p.point)}};
                 },
                 [](const NodePoint& p) -> OrderedJson {
                   return {{"node", p.node}};
                 },
                 [](const GroundPoint& p) -> OrderedJson {
                   return {{"ground", ToJson(p.position)}};
                 }},
      point);
}

OrderedJson ToJson(const std::array<PointDescription, 2>& points) {
  return OrderedJson::array({ToJson(points[0]), ToJson(points[1])});
}

OrderedJson ToJson(const RigidBodyDescription& body) {
  OrderedJson json = {
      {"name", body.name},
      {"formulation",
       body.formulation == Formulation::kAncf ? "ancf" : "conventional"}};
  if (const auto* box = std::get_if<BoxInertia>(&body.inertia)) {
    json["box"] = {{"size", ToJson(box->size)}, {"density", box->density}};
  } else {
    const auto& inertia = std::get<TensorInertia>(body.inertia);
    json["inertia"] = {{"mass", inertia.mass},
                       {"tensor", ToJson(inertia.tensor)},
                       {"volume", inertia.volume}};
  }
  if (const double* one = std::get_if<double>(&body.penalty)) {
    json["penalty"] = *one;
  } else if (const auto* six =
                 std::get_if<std::array<double, 6>>(&body.penalty)) {
    json["penalty"] = *six;
  }
  json["position"] = ToJson(body.position);
  if (const auto* q = std::get_if<Quaternion>(&body.orientation)) {
    json["orientation"]["quaternion"] = {q->w, q->x, q->y, q->z};
  } else {
    json["orientation"]["rotation_vector"] =
        ToJson(std::get<RotationVector>(body.orientation).vector);
  }
  json["velocity"] = ToJson(body.velocity);
  json[body.angular_velocity_in_body_axes ? "angular_velocity_body"
                                          : "angular_velocity"] =
      ToJson(body.angular_velocity);
  json["start"] = body.start == Start::kRelaxed ? "relaxed" : "undeformed";
  return json;
}

OrderedJson ToJson(const NodeDescription& node) {
  OrderedJson json = {{"name", node.name},
                      {"mass", node.mass},
                      {"position", ToJson(node.position)}};
  if (const auto* velocity = std::get_if<Vector3d>(&node.velocity)) {
    json["velocity"] = ToJson(*velocity);
  } else {
    json["velocity"]["moves_with"] = std::get<MovesWith>(node.velocity).body;
  }
  json["fixed"] = node.fixed;
  return json;
}

OrderedJson ToJson(const TrussDescription& truss) {
  OrderedJson json = {{"name", truss.name},
                      {"ends", ToJson(truss.ends)},
                      {"area", truss.area},
                      {"density", truss.density},
                      {"young_modulus", truss.young_modulus}};
  if (truss.length.has_value()) json["length"] = *truss.length;
  json["tension_only"] = truss.tension_only;
  return json;
}

OrderedJson ToJson(const SpringDescription& spring) {
  return {{"name", spring.name},
          {"ends", ToJson(spring.ends)},
          {"stiffness", spring.stiffness},
          {"length", spring.length}};
}

OrderedJson ToJson(const std::variant<ForceLoad, TorqueLoad>& load) {
  return std::visit(
      Overloaded{
          [](const ForceLoad& l) -> OrderedJson {
            return {{"point", ToJson(l.point)}, {"force", ToJson(l.force)}};
          },
          [](const TorqueLoad& l) -> OrderedJson {
            return {{"body", l.body}, {"torque", ToJson(l.torque)}};
          }},
      load);
}

OrderedJson ToJson(const IntegratorSettings& settings) {
  OrderedJson json = {{"method", "energy_momentum"},
                      {"order", settings.order},
                      {"time_step", settings.time_step},
                      {"duration", settings.duration}};
  if (settings.tolerance.has_value()) {
    json["tolerance"] = *settings.tolerance;
  } else {
    json["tolerance"] = "round_off";
  }
  return json;
}

template <typename T>
void AddList(const char* key, const std::vector<T>& list, OrderedJson* json) {
  for (const T& element : list) (*json)[key].push_back(ToJson(element));
}

}  // namespace

std::string WriteCase(const Case& value) {
  OrderedJson json = {{"format", kCaseFormat}, {"name", value.name}};
  if (!value.purpose.empty()) json["purpose"] = value.purpose;
  json["gravity"] = ToJson(value.model.gravity);
  AddList("rigid_bodies", value.model.rigid_bodies, &json);
  AddList("nodes", value.model.nodes, &json);
  AddList("trusses", value.model.trusses, &json);
  AddList("springs", value.model.springs, &json);
  AddList("shared_points", value.model.shared_points, &json);
  AddList("loads", value.model.loads, &json);
  json["integrator"] = ToJson(value.integrator);
  json["output"]["every"] = value.output_every;
  return FormatJson(json) + "\n";
}

}  // namespace emmy
