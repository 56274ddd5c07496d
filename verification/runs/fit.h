// Straight lines through measurements, their percentiles and zeros.

#ifndef EMMY_VERIFICATION_RUNS_FIT_H_
#define EMMY_VERIFICATION_RUNS_FIT_H_

#include <vector>

namespace emmy::verification {

// p of the least-squares line ln y = p ln x + c. NaN unless there are at
// least two points, all x and y positive, and two different x.
double FitPower(const std::vector<double>& x, const std::vector<double>& y);

// The smallest value that at least `fraction` of the values do not exceed
// (0 < fraction ≤ 1). `values` must not be empty.
double Percentile(std::vector<double> values, double fraction);

// The powers of ten 10^first, …, 10^last.
std::vector<double> PowersOfTen(int first, int last, int increment = 1);

// The time in [0, h] at which the cubic through two values and slopes is
// zero, the values having opposite signs; by bisection.
double ZeroOfCubic(double h, double y0, double slope0, double y1,
                   double slope1);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_RUNS_FIT_H_
