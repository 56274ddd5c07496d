// What the results say of one node or line element at one time.

#ifndef EMMY_DIAGNOSTICS_STRUCTURE_MOTION_H_
#define EMMY_DIAGNOSTICS_STRUCTURE_MOTION_H_

#include <cstddef>

#include "emmy/base/export.h"
#include "emmy/base/types.h"
#include "emmy/model/model.h"
#include "emmy/model/point.h"
#include "emmy/model/state.h"

namespace emmy {

// Where a point is, and how fast.
struct PointMotion {
  Vector3d position;  // Inertial [m].
  Vector3d velocity;  // [m/s]
};

// Any point: of a body, a node, or fixed in space (velocity zero).
EMMY_EXPORT PointMotion ObservePoint(const Model& model, const State& state,
                                     const Point& point);

// `node` is an index of model.nodes(); also of nodes that are tied.
EMMY_EXPORT PointMotion ObserveNode(const Model& model, const State& state,
                                    size_t node);

// The strain and the force of a truss, cable or spring.
struct LineObservation {
  double strain = 0.0;  // Green–Lagrange; a spring: see LineElement::Strain.
  double force = 0.0;   // [N], tension positive.
};

// `line` is an index of model.lines().
EMMY_EXPORT LineObservation ObserveLine(const Model& model, const State& state,
                                        size_t line);

}  // namespace emmy

#endif  // EMMY_DIAGNOSTICS_STRUCTURE_MOTION_H_
