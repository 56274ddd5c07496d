// A point of the model: where a force, an element or a constraint attaches.

#ifndef EMMY_MODEL_POINT_H_
#define EMMY_MODEL_POINT_H_

#include <optional>
#include <vector>

#include "emmy/base/types.h"

namespace emmy {

// One vector coordinate (see Model::vectors) and its constant weight.
struct WeightedVector {
  int vector = 0;       // Index in Model::vectors.
  double weight = 0.0;  // φ [-], or ξ [m] on a gradient vector.
};

// A linear function of the coordinates with constant weights:
//   x = x_ground + Σ φₐ qₐ                                        (PNT-1)
// for a point fixed in an ANCF body (φ = 1, ξ₁, ξ₂, ξ₃ on x̄, e₁, e₂, e₃), a
// node (φ = 1) or a point fixed in space (no terms).
// A point fixed in a conventional body, x = x̄ + R ξ, is not linear; it names
// the body and ξ instead and has no terms.
struct Point {
  std::vector<WeightedVector> terms;        // φₐ of qₐ.
  Vector3d ground = Vector3d::Zero();       // x_ground, inertial [m].
  std::optional<size_t> conventional_body;  // Index in Model::bodies.
  Vector3d xi = Vector3d::Zero();           // In that body's axes [m].

  // Fixed in space.
  bool is_ground() const {
    return terms.empty() && !conventional_body.has_value();
  }
};

}  // namespace emmy

#endif  // EMMY_MODEL_POINT_H_
