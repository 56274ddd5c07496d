// Follows the invariants over every step of a run.

#ifndef EMMY_DIAGNOSTICS_INVARIANT_MONITOR_H_
#define EMMY_DIAGNOSTICS_INVARIANT_MONITOR_H_

#include <array>

#include "emmy/base/export.h"
#include "emmy/base/types.h"
#include "emmy/diagnostics/invariants.h"
#include "emmy/model/model.h"
#include "emmy/model/state.h"

namespace emmy {

// Which quantities the model should keep.
struct ConservedQuantities {
  bool energy = true;  // Total energy: always, as the work of loads counts.
  bool momentum = true;
  bool angular_momentum = true;
};

// Gravity, forces and anything fixed to the ground take momentum and angular
// momentum about the origin; a torque takes angular momentum alone.
EMMY_EXPORT ConservedQuantities QuantitiesConservedBy(const Model& model);

// Errors are against the start, differences in extended precision, over every
// observed state. `scale` is the largest kinetic + penalty + elastic energy,
// or the largest norm of the momentum, met so far.
struct EnergyRecord {
  double initial = 0.0;  // Total energy [J].
  double final = 0.0;
  double max_error = 0.0;
  double scale = 0.0;
  bool conserved = true;

  // Zero if both error and scale are zero, NaN if a state was not finite.
  double max_relative_error() const {
    return max_error == 0.0 ? 0.0 : max_error / scale;
  }
};

// The same of momentum [kg m/s] or angular momentum [kg m²/s].
struct MomentumRecord {
  Vector3d initial = Vector3d::Zero();
  Vector3d final = Vector3d::Zero();
  double max_error = 0.0;  // Norm of the difference.
  double scale = 0.0;
  bool conserved = true;

  double max_relative_error() const {
    return max_error == 0.0 ? 0.0 : max_error / scale;
  }
};

// The largest errors and scales so far of energy, momentum and angular
// momentum: what a monitor cannot know from a single state.
struct InvariantExtremes {
  std::array<double, 3> max_error = {};
  std::array<double, 3> scale = {};
};

class EMMY_EXPORT InvariantMonitor {
 public:
  InvariantMonitor(const Model& model, const State& initial);

  void Observe(const State& state);
  // The same, where the state has been measured.
  void Observe(const Invariants& measured);

  InvariantExtremes extremes() const;

  // Goes on with `state` as a monitor that had these extremes there.
  void Resume(const State& state, const InvariantExtremes& extremes);

  const Invariants& latest() const { return latest_; }
  const EnergyRecord& energy() const { return energy_; }
  const MomentumRecord& momentum() const { return momentum_; }
  const MomentumRecord& angular_momentum() const { return angular_momentum_; }

 private:
  const Model* model_;
  Invariants initial_;
  Invariants latest_;
  EnergyRecord energy_;
  MomentumRecord momentum_;
  MomentumRecord angular_momentum_;
};

}  // namespace emmy

#endif  // EMMY_DIAGNOSTICS_INVARIANT_MONITOR_H_
