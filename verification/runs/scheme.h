// How a claim's runs are advanced: the library's integrator, or something that
// is put in its place (a method to compare with, a wrong variant in a test).

#ifndef EMMY_VERIFICATION_RUNS_SCHEME_H_
#define EMMY_VERIFICATION_RUNS_SCHEME_H_

#include <functional>

#include "absl/status/statusor.h"
#include "emmy/integrate/energy_momentum.h"
#include "emmy/model/model.h"
#include "emmy/model/state.h"

namespace emmy::verification {

using StepFunction = std::function<StepReport(State&)>;

// Makes the step function of a model, which outlives it.
using Scheme = std::function<absl::StatusOr<StepFunction>(
    const Model& model, const IntegratorOptions& options)>;

// The library's energy-momentum integrator, unchanged.
absl::StatusOr<StepFunction> EnergyMomentumScheme(
    const Model& model, const IntegratorOptions& options);

// The same step in plain floating point, as one would write it first: sums
// are not compensated, and the strain of an ANCF body is recomputed from its
// coordinates, (ANCF-4). The cancellation in ½ (e·e − 1) is multiplied by b.
absl::StatusOr<StepFunction> PlainArithmeticScheme(
    const Model& model, const IntegratorOptions& options);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_RUNS_SCHEME_H_
