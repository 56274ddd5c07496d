// Work-precision curves: what a digit costs.

#ifndef EMMY_VERIFICATION_TIMING_WORK_PRECISION_H_
#define EMMY_VERIFICATION_TIMING_WORK_PRECISION_H_

#include <string>
#include <vector>

#include "absl/status/status.h"
#include "verification/figures/figure.h"

namespace emmy::verification {

struct WorkPrecisionSeries {
  std::string name;  // Formulation or method.
  int order = 0;
};

struct WorkPrecisionPoint {
  WorkPrecisionSeries series;
  double time_step = 0.0;  // [s]
  double seconds = 0.0;    // Processor time per simulated second [-].
  double error = 0.0;      // Of the angular velocity at 10 s [rad/s].
};

// Points of a series one after the other; `series` counts them from 1.
Figure WorkPrecisionFigure(const std::vector<WorkPrecisionPoint>& points);

// A list of objects with the fields of a point.
std::string WorkPrecisionJson(const std::vector<WorkPrecisionPoint>& points);

// work_precision.csv, .gp, .svg and .json. kUnavailable: as WriteFigure.
absl::Status WriteWorkPrecision(const std::vector<WorkPrecisionPoint>& points,
                                const std::string& directory);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_TIMING_WORK_PRECISION_H_
