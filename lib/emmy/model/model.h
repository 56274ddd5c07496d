// What does not change during a run: bodies, nodes, elements, joints, loads,
// constant masses and the layout of the state.

#ifndef EMMY_MODEL_MODEL_H_
#define EMMY_MODEL_MODEL_H_

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "emmy/base/types.h"
#include "emmy/element/ancf_rigid_body.h"
#include "emmy/element/conventional_rigid_body.h"
#include "emmy/element/line_element.h"
#include "emmy/model/point.h"

namespace emmy {

// One of the 3-vectors that ANCF bodies (x̄, e₁, e₂, e₃) and free nodes (x)
// have for coordinates, and where it is in the state.
struct VectorCoordinate {
  Eigen::Index position_offset = 0;  // Of its first entry in State::position
  Eigen::Index velocity_offset = 0;  // and in State::velocity.
  // Σ over material points of (mass × weight): the linear momentum of the
  // model is Σ first_moment · w, its gravity force first_moment · g [kg].
  double first_moment = 0.0;
};

// One rigid body of the model and where its part of the state begins.
struct ModelBody {
  std::string name;                                            // As described.
  std::variant<AncfRigidBody, ConventionalRigidBody> element;  // Mass, law.
  Eigen::Index position_offset = 0;  // In State::position: 12 entries or 7.
  Eigen::Index velocity_offset = 0;  // In State::velocity: 12 entries or 6.
  Eigen::Index strain_offset = 0;    // In State::strain: 6 entries or none.
  int first_vector = -1;             // Of x̄, e₁, e₂, e₃; ANCF only.

  // The element if it is an ANCF body, else null.
  const AncfRigidBody* ancf() const {
    return std::get_if<AncfRigidBody>(&element);
  }
  // The element if it is a conventional body, else null.
  const ConventionalRigidBody* conventional() const {
    return std::get_if<ConventionalRigidBody>(&element);
  }
  // Of either.
  const RigidBodyInertia& inertia() const {
    return ancf() != nullptr ? ancf()->inertia() : conventional()->inertia();
  }
};

// A node, which may be tied to a point of a body.
struct ModelNode {
  std::string name;  // As described.
  Point point;       // Itself, or what it is tied to.
};

// A truss, cable or spring between two points.
struct ModelLine {
  std::string name;           // As described.
  LineElement element;        // Its law.
  std::array<Point, 2> ends;  // x₁ and x₂.
  Point difference;  // d = x₂ − x₁ as one linear function; linear ends only.
  double mass = 0.0;  // ρ A L, consistent: m/6 [2 1; 1 2] ⊗ 1 [kg].
  Eigen::Index strain_offset = 0;  // Of y (LINE-3 … 5) in State::strain.
  // Of the velocity that an end on a conventional body has of its own, in
  // State::end_velocity; −1 for other ends and for elements without mass.
  std::array<Eigen::Index, 2> end_velocity_offset = {-1, -1};

  // Then d is not linear in the coordinates.
  bool has_conventional_end() const {
    return ends[0].conventional_body.has_value() ||
           ends[1].conventional_body.has_value();
  }
};

// Two points that stay together: Σ weight · q is constant (rows of G).
struct ModelConstraint {
  std::string name;                   // JSON pointer, for messages.
  std::vector<WeightedVector> terms;  // A row of G.
  bool to_ground = false;             // One of the points is fixed in space.
};

// Two points, of conventional bodies or of one and the ground, that stay
// together: x₁ − x₂ = 0 along the directions held.           (CONJ-1, CONJ-2)
struct ModelJoint {
  std::string name;  // JSON pointer, for messages.
  // The second, on a body or on the ground, is exactly where the first is at
  // the start: `rest` is what a double leaves out of its ξ or its place.
  std::array<Point, 2> points;
  Vector3d rest = Vector3d::Zero();  // [m]
  // Projection onto the directions that are not held by other joints already,
  // in axes of the first point's body.
  Matrix3d held = Matrix3d::Identity();
  int num_held = 3;  // How many these are.

  // The second point is fixed in space.
  bool to_ground() const { return points[1].is_ground(); }
};

// A constant force at a point.
struct ModelForce {
  Point point;                        // Where it acts.
  Vector3d force = Vector3d::Zero();  // Inertial [N].
};

// A constant torque on a body.
struct ModelTorque {
  size_t body = 0;                     // Index in Model::bodies.
  Vector3d torque = Vector3d::Zero();  // Inertial [N m].
};

// Mass between two vector coordinates (both orders are stored) [kg, kg m,
// kg m²]; M ⊗ 1 is the constant mass matrix of the linear coordinates.
struct MassEntry {
  int column = 0;     // Index in Model::vectors.
  double mass = 0.0;  // Entry of M.
};

// Mass between a point fixed in space and a vector coordinate, from an element
// with consistent mass: counts in the angular momentum only.
struct GroundMass {
  Vector3d position = Vector3d::Zero();  // Of the fixed point [m].
  int vector = 0;                        // Index in Model::vectors.
  double mass = 0.0;                     // [kg], [kg m] with a gradient.
};

// Immutable after BuildModel (model_builder.h).
class Model {
 public:
  const Vector3d& gravity() const { return gravity_; }  // Inertial [m/s²].
  // In the order of the description, as all of these.
  const std::vector<ModelBody>& bodies() const { return bodies_; }
  // Free, tied and fixed ones.
  const std::vector<ModelNode>& nodes() const { return nodes_; }
  // Trusses and cables, then springs.
  const std::vector<ModelLine>& lines() const { return lines_; }
  // Shared points where both are linear in the coordinates.
  const std::vector<ModelConstraint>& constraints() const {
    return constraints_;
  }
  // Shared points of conventional bodies.
  const std::vector<ModelJoint>& joints() const { return joints_; }
  // Loads at points; gravity is not among them.
  const std::vector<ModelForce>& forces() const { return forces_; }
  // Loads on bodies.
  const std::vector<ModelTorque>& torques() const { return torques_; }
  // The columns of M and of G.
  const std::vector<VectorCoordinate>& vectors() const { return vectors_; }
  // Row v of M: the masses between vector v and others.
  const std::vector<std::vector<MassEntry>>& mass() const { return mass_; }
  // Of elements with mass that are fixed in space at one end.
  const std::vector<GroundMass>& ground_mass() const { return ground_mass_; }

  // Entries of State::position.
  Eigen::Index num_positions() const { return num_positions_; }
  // Entries of State::velocity.
  Eigen::Index num_velocities() const { return num_velocities_; }
  // Entries of State::strain: six an ANCF body, one a truss, cable or spring.
  Eigen::Index num_strains() const { return num_strains_; }
  // Entries of State::end_velocity.
  Eigen::Index num_end_velocities() const { return num_end_velocities_; }

  // Forces of constraints, then of joints, in the state: three each.
  Eigen::Index num_multipliers() const {
    return 3 * static_cast<Eigen::Index>(constraints_.size() + joints_.size());
  }

  // Independent velocities: 12 for an ANCF body, 6 for a conventional one, 3
  // for a free node, less 3 for each constraint and the directions that each
  // joint holds.
  Eigen::Index degrees_of_freedom() const {
    Eigen::Index held = 3 * static_cast<Eigen::Index>(constraints_.size());
    for (const ModelJoint& joint : joints_) held += joint.num_held;
    return num_velocities_ - held;
  }

 private:
  friend class ModelAssembler;

  Vector3d gravity_ = Vector3d::Zero();
  std::vector<ModelBody> bodies_;
  std::vector<ModelNode> nodes_;
  std::vector<ModelLine> lines_;
  std::vector<ModelConstraint> constraints_;
  std::vector<ModelJoint> joints_;
  std::vector<ModelForce> forces_;
  std::vector<ModelTorque> torques_;
  std::vector<VectorCoordinate> vectors_;
  std::vector<std::vector<MassEntry>> mass_;
  std::vector<GroundMass> ground_mass_;
  Eigen::Index num_positions_ = 0;
  Eigen::Index num_velocities_ = 0;
  Eigen::Index num_strains_ = 0;
  Eigen::Index num_end_velocities_ = 0;
};

}  // namespace emmy

#endif  // EMMY_MODEL_MODEL_H_
