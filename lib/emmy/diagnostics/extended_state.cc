#include "emmy/diagnostics/extended_state.h"

#include "emmy/numerics/rotation.h"

namespace emmy {

std::array<DoubleDouble3, 3> ExtendedFrame(const ModelBody& body,
                                           const State& state) {
  const Eigen::Index q = body.position_offset + 3;
  return QuaternionToMatrix(
      {Extended(state.position, q), Extended(state.position, q + 1),
       Extended(state.position, q + 2), Extended(state.position, q + 3)});
}

DoubleDouble3 ExtendedPosition(const Model& model, const State& state,
                               const Point& point) {
  DoubleDouble3 position = DoubleDouble3::FromDouble(point.ground);
  if (point.conventional_body.has_value()) {
    const ModelBody& body = model.bodies()[*point.conventional_body];
    const std::array<DoubleDouble3, 3> frame = ExtendedFrame(body, state);
    position = Extended3(state.position, body.position_offset);
    for (int i = 0; i < 3; ++i) {
      position += DoubleDouble(point.xi(i)) * frame[static_cast<size_t>(i)];
    }
  }
  for (const WeightedVector& term : point.terms) {
    const VectorCoordinate& v =
        model.vectors()[static_cast<size_t>(term.vector)];
    position += DoubleDouble(term.weight) *
                Extended3(state.position, v.position_offset);
  }
  return position;
}

}  // namespace emmy
