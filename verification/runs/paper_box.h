// The box of the paper's section 5.1: 3 × 2 × 1 m, 2700 kg/m³, free, with
// ω₀ = (0.3, 0.5, 0.8) rad/s; and that of 5.2, with a truss on one corner.

#ifndef EMMY_VERIFICATION_RUNS_PAPER_BOX_H_
#define EMMY_VERIFICATION_RUNS_PAPER_BOX_H_

#include <string>

#include "emmy/model/model_description.h"

namespace emmy::verification {

constexpr double kPaperTimeStep = 1e-3;  // Δt [s]
constexpr double kPaperDuration = 10.0;  // [s]

// As an ANCF body; `penalty` α [Pa].
ModelDescription PaperBoxAncf(double penalty, Start start = Start::kUndeformed);

ModelDescription PaperBoxConventional();

// The same with a truss of 0.8 m, EA = 7 MN, from the corner (1.5, 1, 0.5)
// along +ξ₃ to a node that turns with the box.
ModelDescription PaperTrussAncf(double penalty);
ModelDescription PaperTrussConventional();

// "alpha = 1e+06 Pa"
std::string PenaltyLabel(double penalty);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_RUNS_PAPER_BOX_H_
