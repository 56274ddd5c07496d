#include "emmy/io/case.h"

#include <cmath>
#include <limits>

#include "emmy/base/check.h"

namespace emmy {

int64_t NumberOfSteps(const IntegratorSettings& settings) {
  const double quotient = settings.duration / settings.time_step;
  EMMY_CHECK(quotient > 0.0 && quotient <= kMaxSteps,
             "duration = " << settings.duration
                           << ", time_step = " << settings.time_step);
  constexpr double kFourUnits = 2.0 * std::numeric_limits<double>::epsilon();
  const double nearest = std::round(quotient);
  const bool is_whole = std::abs(quotient - nearest) <= kFourUnits * quotient;
  return static_cast<int64_t>(is_whole ? nearest : std::ceil(quotient));
}

IntegratorOptions OptionsOf(const IntegratorSettings& settings,
                            int num_threads) {
  return {.order = settings.order,
          .time_step = settings.time_step,
          .tolerance = settings.tolerance,
          .num_threads = num_threads};
}

}  // namespace emmy
