// The integrators of integrators.h in the place of the library's: as schemes
// that advance a State, so that all that measures runs measures them too.
//
// The state they leave has no compensations, and the strain of its
// coordinates.

#ifndef EMMY_VERIFICATION_BASELINES_BASELINE_SCHEME_H_
#define EMMY_VERIFICATION_BASELINES_BASELINE_SCHEME_H_

#include <functional>
#include <string>
#include <vector>

#include "verification/runs/scheme.h"

namespace emmy::verification {

enum class Baseline { kNewmark, kMidpoint, kGeneralizedAlpha, kVerlet };

// ρ of (BASE-4).
inline constexpr double kBaselineSpectralRadius = 0.8;

const std::vector<Baseline>& AllBaselines();
std::string BaselineName(Baseline baseline);  // "Newmark", "midpoint", …

// Its function fails with kUnimplemented for models that SystemOfModel does
// not cover. A step that does not converge leaves the state alone.
Scheme BaselineScheme(Baseline baseline);

// How claims get the methods they compare with; tests put others here.
using BaselineSource = std::function<Scheme(Baseline)>;

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_BASELINES_BASELINE_SCHEME_H_
