#include "emmy/diagnostics/structure_motion.h"

#include <Eigen/Geometry>

#include "emmy/base/check.h"
#include "emmy/diagnostics/extended_state.h"
#include "emmy/numerics/rotation.h"

namespace emmy {

PointMotion ObservePoint(const Model& model, const State& state,
                         const Point& point) {
  PointMotion motion{ExtendedPosition(model, state, point).ToDouble(),
                     Vector3d::Zero()};
  if (point.conventional_body.has_value()) {
    const ModelBody& body = model.bodies()[*point.conventional_body];
    const Eigen::Index q = body.position_offset;
    const Eigen::Index w = body.velocity_offset;
    const Matrix3d rotation =
        QuaternionToMatrix(Vector4d(state.position.value.segment<4>(q + 3)));
    const Vector3d omega = state.velocity.value.segment<3>(w + 3);
    motion.velocity =
        state.velocity.value.segment<3>(w) + rotation * omega.cross(point.xi);
  }
  for (const WeightedVector& term : point.terms) {
    const VectorCoordinate& v =
        model.vectors()[static_cast<size_t>(term.vector)];
    motion.velocity +=
        term.weight * state.velocity.value.segment<3>(v.velocity_offset);
  }
  return motion;
}

PointMotion ObserveNode(const Model& model, const State& state, size_t node) {
  EMMY_CHECK(node < model.nodes().size(),
             "node " << node << " of " << model.nodes().size());
  return ObservePoint(model, state, model.nodes()[node].point);
}

LineObservation ObserveLine(const Model& model, const State& state,
                            size_t line) {
  EMMY_CHECK(line < model.lines().size(),
             "line " << line << " of " << model.lines().size());
  const ModelLine& element = model.lines()[line];
  const double value = state.strain.value(element.strain_offset);
  return {element.element.Strain(value), element.element.Tension(value)};
}

}  // namespace emmy
