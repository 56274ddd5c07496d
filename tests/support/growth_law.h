// How an error grows with the number of steps, over an ensemble of runs.
//
// Errors that are rounding alone are a random walk: |ΔE| ~ √N. A systematic
// part, however small, makes a drift: |ΔE| ~ N (Brouwer's law).

#ifndef EMMY_TESTS_SUPPORT_GROWTH_LAW_H_
#define EMMY_TESTS_SUPPORT_GROWTH_LAW_H_

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <vector>

namespace emmy {

struct GrowthLaw {
  double exponent = 0.0;
  // 90th percentile of |error| at each number of steps.
  std::vector<double> sizes;

  bool IsRandomWalk() const {
    return exponent > 0.35 && exponent < 0.65;  // NaN is not.
  }
  friend std::ostream& operator<<(std::ostream& os, const GrowthLaw& law) {
    os << "N^" << law.exponent << ", sizes";
    for (const double size : law.sizes) os << ' ' << size;
    return os;
  }
};

// `errors[k]` are the errors of all runs after `steps[k]`. The law is fitted by
// least squares to log |error| over log N at the 90th percentile: a single run
// passes through zero, which a logarithm cannot bear, and the median of |ΔE| is
// near it; the largest is one run alone. Of 32 runs of a random walk the
// percentile has a standard deviation of 16 %, so that the exponent from five
// points over two decades has one of 0.05, and ± 0.15 is three of them.
inline GrowthLaw FitGrowthLaw(const std::vector<int64_t>& steps,
                              std::vector<std::vector<double>> errors) {
  GrowthLaw law;
  double sum_x = 0.0;
  double sum_y = 0.0;
  double sum_xx = 0.0;
  double sum_xy = 0.0;
  for (size_t k = 0; k < steps.size(); ++k) {
    std::vector<double>& sample = errors[k];
    for (double& error : sample) error = std::abs(error);
    std::sort(sample.begin(), sample.end());
    law.sizes.push_back(sample[sample.size() * 9 / 10]);
    const double x = std::log(static_cast<double>(steps[k]));
    const double y = std::log(law.sizes.back());
    sum_x += x;
    sum_y += y;
    sum_xx += x * x;
    sum_xy += x * y;
  }
  const auto n = static_cast<double>(steps.size());
  law.exponent = (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
  return law;
}

}  // namespace emmy

#endif  // EMMY_TESTS_SUPPORT_GROWTH_LAW_H_
