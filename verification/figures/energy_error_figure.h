// The figure of the README: energy error against the number of steps, as
// the library computes it and in plain arithmetic.

#ifndef EMMY_VERIFICATION_FIGURES_ENERGY_ERROR_FIGURE_H_
#define EMMY_VERIFICATION_FIGURES_ENERGY_ERROR_FIGURE_H_

#include <cstdint>
#include <vector>

#include "absl/status/statusor.h"
#include "verification/figures/figure.h"
#include "verification/runs/scheme.h"

namespace emmy::verification {

struct EnergyErrorCurve {
  double penalty = 0.0;  // α [Pa]
  // Largest |E − E₀| / E up to each reading.
  std::vector<double> errors;        // By the scheme.
  std::vector<double> naive_errors;  // By PlainArithmeticScheme.
};

struct EnergyErrorStudy {
  std::vector<double> steps;  // Readings, ten a decade.
  std::vector<EnergyErrorCurve> curves;
};

// The paper's box, steps of 1 ms, several penalties.
absl::StatusOr<EnergyErrorStudy> StudyEnergyError(int64_t num_steps,
                                                  const Scheme& scheme);

Figure EnergyErrorFigure(const EnergyErrorStudy& study);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_FIGURES_ENERGY_ERROR_FIGURE_H_
