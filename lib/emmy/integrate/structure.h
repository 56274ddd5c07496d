// One connected part of a model, with its own numbering.
//
// Parts that share no element, constraint or mass move independently and are
// solved apart: a free body never enters a sparse system.

#ifndef EMMY_INTEGRATE_STRUCTURE_H_
#define EMMY_INTEGRATE_STRUCTURE_H_

#include <vector>

#include "emmy/base/types.h"
#include "emmy/model/model.h"

namespace emmy {

struct Structure {
  // With the places of its numbers in the structure.
  struct Body {
    const ModelBody* body = nullptr;
    int first = 0;         // Local number of x̄.
    int first_strain = 0;  // Local.
  };
  // A truss, cable or spring.
  struct Line {
    const ModelLine* line = nullptr;
    std::vector<WeightedVector> terms;  // Of d, local numbers.
    int strain = 0;                     // Local.
  };
  // A joint: Σ weight · q over its terms is constant.
  struct Constraint {
    size_t index = 0;  // Of the model.
    std::vector<WeightedVector> terms;
  };
  // A constant force at a point of the structure.
  struct Force {
    std::vector<WeightedVector> terms;
    Vector3d force = Vector3d::Zero();
  };
  // A constant torque on a body.
  struct Torque {
    int first = 0;  // Local number of x̄.
    Vector3d torque = Vector3d::Zero();
  };
  // An entry of the mass matrix.
  struct Mass {
    int row = 0;
    int column = 0;  // ≤ row: each pair once.
    double mass = 0.0;
  };

  std::vector<VectorCoordinate> vectors;
  std::vector<Body> bodies;
  std::vector<Line> lines;
  std::vector<Constraint> constraints;
  std::vector<Force> forces;
  std::vector<Torque> torques;
  std::vector<Mass> masses;
  Vector3d gravity = Vector3d::Zero();       // [m/s²]
  Matrix3Xd gravity_force;                   // Constant [N].
  std::vector<Eigen::Index> strain_offsets;  // In the state, by local number.

  // Whether a vector moves with a translation of the whole: all but the
  // gradient vectors of bodies.
  std::vector<bool> translates;

  // A single ANCF body to which nothing is attached.
  bool is_free_body() const {
    return bodies.size() == 1 && vectors.size() == 4 && lines.empty() &&
           constraints.empty() && forces.empty() && torques.empty() &&
           !has_added_mass;
  }
  bool has_added_mass = false;  // Nodes tied to the body.
  // An element or a constraint ends at a point fixed in space, so that net
  // force and moment need not vanish.
  bool is_grounded = false;

  int num_vectors() const { return static_cast<int>(vectors.size()); }
  int num_constraints() const { return static_cast<int>(constraints.size()); }
};

// The connected parts of `model`'s vector coordinates. Lines, forces and
// torques on conventional bodies are not part of any.
std::vector<Structure> SplitIntoStructures(const Model& model);

}  // namespace emmy

#endif  // EMMY_INTEGRATE_STRUCTURE_H_
