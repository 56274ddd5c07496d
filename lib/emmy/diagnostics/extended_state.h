// Parts of a state in extended precision: value plus compensation.

#ifndef EMMY_DIAGNOSTICS_EXTENDED_STATE_H_
#define EMMY_DIAGNOSTICS_EXTENDED_STATE_H_

#include <array>

#include "emmy/base/compensated_sum.h"
#include "emmy/base/double_double.h"
#include "emmy/model/model.h"
#include "emmy/model/point.h"
#include "emmy/model/state.h"

namespace emmy {

inline DoubleDouble Extended(const CompensatedVector& v, Eigen::Index i) {
  return {v.value(i), v.compensation(i)};
}

// Entries i, i + 1 and i + 2.
inline DoubleDouble3 Extended3(const CompensatedVector& v, Eigen::Index i) {
  return {{Extended(v, i), Extended(v, i + 1), Extended(v, i + 2)}};
}

// The body axes of a conventional body, in the inertial frame.
std::array<DoubleDouble3, 3> ExtendedFrame(const ModelBody& body,
                                           const State& state);

// Position [m] of any point, (PNT-1) or x̄ + R ξ.
DoubleDouble3 ExtendedPosition(const Model& model, const State& state,
                               const Point& point);

}  // namespace emmy

#endif  // EMMY_DIAGNOSTICS_EXTENDED_STATE_H_
