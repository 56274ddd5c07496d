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
  bool energy = true;    // Total energy: always, as the work of loads counts.
  bool momentum = true;  // All three components, or none.
  bool angular_momentum = true;  // The same, about the inertial origin.
};

// Gravity, forces and anything fixed to the ground take momentum and angular
// momentum about the origin; a torque takes angular momentum alone.
EMMY_EXPORT ConservedQuantities QuantitiesConservedBy(const Model& model);

// Errors are against the start, differences in extended precision, over every
// observed state. `scale` is the largest kinetic + penalty + elastic energy,
// or the largest norm of the momentum, met so far.
struct EnergyRecord {
  double initial = 0.0;    // Total energy at the start [J].
  double final = 0.0;      // Of the state observed last [J].
  double max_error = 0.0;  // Largest |E − E₀| so far [J].
  double scale = 0.0;      // What errors are relative to [J].
  bool conserved = true;   // ConservedQuantities has it.

  // Zero if both error and scale are zero, NaN if a state was not finite.
  double max_relative_error() const {
    return max_error == 0.0 ? 0.0 : max_error / scale;
  }
};

// The same of momentum [kg m/s] or angular momentum [kg m²/s].
struct MomentumRecord {
  Vector3d initial = Vector3d::Zero();  // At the start, inertial frame.
  Vector3d final = Vector3d::Zero();    // Of the state observed last.
  double max_error = 0.0;               // Largest norm of the difference.
  double scale = 0.0;                   // What errors are relative to.
  bool conserved = true;                // ConservedQuantities has it.

  // Zero if both error and scale are zero, NaN if a state was not finite. Of
  // the order of 1 where the momentum itself is zero but for rounding.
  double max_relative_error() const {
    return max_error == 0.0 ? 0.0 : max_error / scale;
  }
};

// The largest errors and scales so far of energy, momentum and angular
// momentum: what a monitor cannot know from a single state.
struct InvariantExtremes {
  std::array<double, 3> max_error = {};  // [J], [kg m/s], [kg m²/s]
  std::array<double, 3> scale = {};      // In the same units.
};

class EMMY_EXPORT InvariantMonitor {
 public:
  // `model` must outlive the monitor. Measures `initial`, which errors are
  // against; EMMY_CHECK: it is a state of the model.
  InvariantMonitor(const Model& model, const State& initial);

  // Measures a later state of the same model.
  void Observe(const State& state);
  // The same, where the state has been measured.
  void Observe(const Invariants& measured);

  // For a checkpoint.
  InvariantExtremes extremes() const;

  // Goes on with `state` as a monitor that had these extremes there.
  void Resume(const State& state, const InvariantExtremes& extremes);

  // Of the state observed last.
  const Invariants& latest() const { return latest_; }
  // Of total energy.
  const EnergyRecord& energy() const { return energy_; }
  // Of momentum [kg m/s].
  const MomentumRecord& momentum() const { return momentum_; }
  // Of angular momentum about the inertial origin [kg m²/s].
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
