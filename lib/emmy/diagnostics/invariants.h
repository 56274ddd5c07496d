// Energy, momentum and angular momentum, in extended precision.
//
//   T = ½ M |x̄̇|² + ½ Mⁱʲ ėᵢ·ėⱼ            U = ½ Σ bₖ εₖ²     (ANCF-1, 5)
//   P = M x̄̇,     L = x̄ × P + Mⁱʲ eᵢ × ėⱼ                        (ANCF-7)
//   conventional: T = ½ M |x̄̇|² + ½ W·JW,  L = x̄ × P + R J W       (CRB-2)
// All from values plus compensations, in double-double arithmetic, rounded to
// a double once at the end: a measurement in doubles would add its own 1e-16.
//
// Angular momentum is about the inertial origin. The penalty energy is that of
// the carried strain; StrainGap tells how far that is from the strain of the
// coordinates.

#ifndef EMMY_DIAGNOSTICS_INVARIANTS_H_
#define EMMY_DIAGNOSTICS_INVARIANTS_H_

#include "emmy/base/double_double.h"
#include "emmy/base/export.h"
#include "emmy/base/types.h"
#include "emmy/model/model.h"
#include "emmy/model/state.h"

namespace emmy {

struct Invariants {
  DoubleDouble kinetic_energy;     // T, nodes and trusses included [J].
  DoubleDouble penalty_energy;     // U of the ANCF bodies [J].
  DoubleDouble elastic_energy;     // W of trusses, cables and springs [J].
  DoubleDouble gravity_energy;     // −Σ M g·x̄ [J], zero at the origin.
  DoubleDouble load_work;          // Of the loads since the start [J].
  DoubleDouble3 momentum;          // P [kg m/s]
  DoubleDouble3 angular_momentum;  // L [kg m²/s]

  // Kinetic + penalty + elastic energy: the scale of energy errors.
  DoubleDouble InternalEnergy() const {
    return kinetic_energy + penalty_energy + elastic_energy;
  }
  // Constant in every case, loads or not.
  DoubleDouble TotalEnergy() const {
    return InternalEnergy() + gravity_energy - load_work;
  }
};

// Of `state`, which is one of `model`.
EMMY_EXPORT Invariants MeasureInvariants(const Model& model,
                                         const State& state);

// Whether energy, momentum and angular momentum, and their norms, are finite.
EMMY_EXPORT bool IsFinite(const Invariants& invariants);

// Largest difference between a carried strain and (ANCF-4) of the coordinates
// with their compensations, in extended precision [-].
EMMY_EXPORT double StrainGap(const Model& model, const State& state);

}  // namespace emmy

#endif  // EMMY_DIAGNOSTICS_INVARIANTS_H_
