#include "verification/runs/external_body.h"

#include <nlohmann/json.hpp>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "verification/reference/json_file.h"
#include "verification/reference/project_directory.h"
#include "verification/runs/published_number.h"

namespace emmy::verification {
namespace {

using Json = nlohmann::json;

Vector3d Numbers(const Json& json) {
  return {PublishedNumber(json.at(0)), PublishedNumber(json.at(1)),
          PublishedNumber(json.at(2))};
}

ExternalState StateFromRow(const Json& row) {
  ExternalState state;
  state.time = PublishedNumber(row.at(0));
  for (int i = 0; i < 9; ++i) {
    state.attitude(i / 3, i % 3) =
        PublishedNumber(row.at(static_cast<size_t>(1 + i)));
  }
  for (int i = 0; i < 3; ++i) {
    state.body_angular_velocity(i) =
        PublishedNumber(row.at(static_cast<size_t>(10 + i)));
  }
  return state;
}

ExternalBody BodyFromJson(const Json& json) {
  ExternalBody body;
  body.name = json.at("name").get<std::string>();
  body.mass = PublishedNumber(json.at("mass").at("value"));
  body.inertia = Numbers(json.at("inertia").at("value"));
  body.position = Numbers(json.at("position").at("value"));
  body.velocity = Numbers(json.at("velocity").at("value"));
  body.gravity = Numbers(json.at("gravity").at("value"));
  body.body_angular_velocity =
      Numbers(json.at("body_angular_velocity").at("value"));
  if (json.contains("flip_times")) {
    for (const Json& time : json.at("flip_times").at("value")) {
      body.flip_times.push_back(PublishedNumber(time));
    }
  }
  for (const Json& row : json.at("rows")) {
    body.states.push_back(StateFromRow(row));
  }
  return body;
}

ModelDescription Describe(const ExternalBody& external) {
  RigidBodyDescription body;
  body.name = external.name;
  // Volume 1 m³, so that the penalty is the stiffness.
  body.inertia = TensorInertia{.mass = external.mass,
                               .tensor = external.inertia.asDiagonal(),
                               .volume = 1.0};
  body.position = external.position;
  body.velocity = external.velocity;
  body.angular_velocity = external.body_angular_velocity;
  body.angular_velocity_in_body_axes = true;
  ModelDescription model;
  model.gravity = external.gravity;
  model.rigid_bodies.push_back(body);
  return model;
}

}  // namespace

ModelDescription ExternalBody::Conventional() const {
  ModelDescription model = Describe(*this);
  model.rigid_bodies[0].formulation = Formulation::kConventional;
  return model;
}

ModelDescription ExternalBody::Ancf(double stiffness) const {
  ModelDescription model = Describe(*this);
  model.rigid_bodies[0].formulation = Formulation::kAncf;
  model.rigid_bodies[0].penalty = stiffness;
  model.rigid_bodies[0].start = Start::kRelaxed;
  return model;
}

absl::StatusOr<std::vector<ExternalBody>> ReadExternalBodies() {
  const std::string path =
      ProjectDirectory() + "/reference_data/external/free_rigid_bodies.json";
  const absl::StatusOr<Json> json = ReadJsonFile(path);
  if (!json.ok()) return json.status();
  std::vector<ExternalBody> bodies;
  try {
    for (const Json& body : json->at("cases")) {
      bodies.push_back(BodyFromJson(body));
    }
  } catch (const Json::exception& error) {
    return absl::DataLossError(absl::StrCat(path, ": ", error.what()));
  }
  return bodies;
}

}  // namespace emmy::verification
