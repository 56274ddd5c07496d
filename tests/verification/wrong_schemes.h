// The library's step made wrong on purpose, to see that a claim notices.

#ifndef EMMY_TESTS_VERIFICATION_WRONG_SCHEMES_H_
#define EMMY_TESTS_VERIFICATION_WRONG_SCHEMES_H_

#include "verification/runs/scheme.h"

namespace emmy::verification {

// Iterates only to a relative correction of `tolerance`.
Scheme LooseNewton(double tolerance);

// Gives up after `iterations`.
Scheme FewIterations(int iterations);

// Every velocity is rounded away from zero by the relative part `bias`.
Scheme BiasedRounding(double bias);

// The first component of every velocity vector is too large by the relative
// part `bias` after each step: one direction is not like the others.
Scheme PreferredAxis(double bias);

// Each step is longer than asked by the relative part `error`; of ANCF bodies
// only, if so asked.
Scheme WrongClock(double error, bool ancf_only = false);

// Each step is longer by `factor` Δt of itself: first order in Δt.
Scheme FirstOrderClock(double factor);

// Orders 4 and 6 composed of single steps instead of pairs (COMP-1).
absl::StatusOr<StepFunction> UnpairedComposition(
    const Model& model, const IntegratorOptions& options);

// Advances with the order `order`, whatever was asked.
Scheme OtherOrder(int order);

// The first strain is off by `kick` after the first step.
Scheme StrainKick(double kick);

// Says that a step has converged where it has not, and leaves the state.
absl::StatusOr<StepFunction> SilentFailure(const Model& model,
                                           const IntegratorOptions& options);

}  // namespace emmy::verification

#endif  // EMMY_TESTS_VERIFICATION_WRONG_SCHEMES_H_
