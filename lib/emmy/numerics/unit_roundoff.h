// The unit of rounding errors.

#ifndef EMMY_NUMERICS_UNIT_ROUNDOFF_H_
#define EMMY_NUMERICS_UNIT_ROUNDOFF_H_

#include <limits>

namespace emmy {

// u, half the distance from 1 to the next double: the bound on the relative
// error of one operation, rounded to nearest.
inline constexpr double kUnitRoundoff =
    std::numeric_limits<double>::epsilon() / 2.0;

}  // namespace emmy

#endif  // EMMY_NUMERICS_UNIT_ROUNDOFF_H_
