// Checks one rigid body's description and makes its element and start.

#ifndef EMMY_MODEL_RIGID_BODY_ASSEMBLY_H_
#define EMMY_MODEL_RIGID_BODY_ASSEMBLY_H_

#include <string>
#include <variant>

#include "absl/status/statusor.h"
#include "emmy/base/types.h"
#include "emmy/element/ancf_rigid_body.h"
#include "emmy/element/conventional_rigid_body.h"
#include "emmy/model/model_description.h"

namespace emmy {

// The element and its part of the first state. For an ANCF body the start is
// exact beyond a double: the low-order parts go into the compensations, so
// that the coordinates have the strain that is carried, to 1e-31.
struct AssembledRigidBody {
  explicit AssembledRigidBody(const RigidBodyInertia& inertia)
      : element(ConventionalRigidBody(inertia)) {}

  std::variant<AncfRigidBody, ConventionalRigidBody> element;
  VectorXd position;
  VectorXd position_compensation;
  VectorXd velocity;
  VectorXd velocity_compensation;
  VectorXd strain;
  Vector3d angular_velocity = Vector3d::Zero();  // Inertial [rad/s].
};

// `pointer` is the body's place in the description, e.g. `/rigid_bodies/0`.
absl::StatusOr<AssembledRigidBody> AssembleRigidBody(
    const std::string& pointer, const RigidBodyDescription& description);

}  // namespace emmy

#endif  // EMMY_MODEL_RIGID_BODY_ASSEMBLY_H_
