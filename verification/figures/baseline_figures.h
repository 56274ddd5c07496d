// Energy-momentum beside the usual integrators: energy errors over time, and
// over the time step and the penalty.

#ifndef EMMY_VERIFICATION_FIGURES_BASELINE_FIGURES_H_
#define EMMY_VERIFICATION_FIGURES_BASELINE_FIGURES_H_

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "emmy/model/model_description.h"
#include "verification/baselines/baseline_scheme.h"
#include "verification/figures/figure.h"
#include "verification/runs/scheme.h"

namespace emmy::verification {

// A method of the comparison: the scheme of the claim first, then all
// baselines.
struct Method {
  std::string name;
  Scheme scheme;
};
std::vector<Method> ComparedMethods(const Scheme& scheme,
                                    const BaselineSource& baseline);

// Largest errors over the steps so far, relative to the start.
struct ConservationHistory {
  std::vector<double> energy;  // |E − E₀| / E₀ at each reading.
  double largest_energy = 0.0;
  double largest_angular_momentum = 0.0;  // |L − L₀| / |L₀|
  // When |E − E₀| exceeded ½ E₀ or a step found no solution; the duration if
  // that did not happen [s].
  double time_of_loss = 0.0;
};

// Follows a run to `duration`; readings are times in ascending order. Where a
// step has no solution the run ends, and readings are NaN; where it is lost in
// numbers above 1e200, that is its error from there on.
absl::StatusOr<ConservationHistory> FollowRun(
    const ModelDescription& description, double time_step, double duration,
    const std::vector<double>& readings, const Scheme& scheme);

// One panel: all methods at one penalty and time step.
struct BaselinePanel {
  double penalty = 0.0;    // α [Pa]
  double time_step = 0.0;  // Δt [s]
  std::vector<ConservationHistory> methods;
};

struct BaselineStudy {
  double duration = 0.0;         // [s]
  std::vector<double> readings;  // [s]
  std::vector<std::string> names;
  std::vector<BaselinePanel> panels;
};

using PenaltyModel = ModelDescription (*)(double penalty);

// Three panels: vibration resolved, not resolved, large steps.
absl::StatusOr<BaselineStudy> StudyBaselines(
    PenaltyModel model, double duration, const std::vector<Method>& methods);
Figure BaselineHistoryFigure(const BaselineStudy& study,
                             const std::string& name, const std::string& title);

// A grid of penalties and of steps from 1 ms to 0.1 s. Runs that are lost, see
// time_of_loss, are shown with an error of one at least.
absl::StatusOr<BaselineStudy> MapBaselines(PenaltyModel model, double duration,
                                           const std::vector<double>& penalties,
                                           const std::vector<Method>& methods);
Figure BaselineMapFigure(const BaselineStudy& study, const std::string& name,
                         const std::string& title);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_FIGURES_BASELINE_FIGURES_H_
