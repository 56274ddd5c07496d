// A maximum in which nothing that is not a number gets lost.

#ifndef EMMY_BASE_LARGER_H_
#define EMMY_BASE_LARGER_H_

#include <algorithm>
#include <cmath>
#include <limits>

namespace emmy {

// The larger, or NaN if one is: std::max would drop it.
inline double Larger(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return std::max(a, b);
}

}  // namespace emmy

#endif  // EMMY_BASE_LARGER_H_
