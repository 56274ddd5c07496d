// How times grow with the size of a model, drawn.

#ifndef EMMY_VERIFICATION_TIMING_GROWTH_FIGURE_H_
#define EMMY_VERIFICATION_TIMING_GROWTH_FIGURE_H_

#include "verification/figures/figure.h"
#include "verification/timing/timing.h"

namespace emmy::verification {

// Time of a step over size, a curve for each of Growths() and a line of
// proportion; a size that was not measured is left out.
Figure GrowthFigure(const TimingRun& run);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_TIMING_GROWTH_FIGURE_H_
