#include "verification/runs/fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "emmy/base/check.h"

namespace emmy::verification {

double FitPower(const std::vector<double>& x, const std::vector<double>& y) {
  EMMY_CHECK(x.size() == y.size(), x.size() << " and " << y.size());
  const auto n = static_cast<double>(x.size());
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (size_t i = 0; i < x.size(); ++i) {
    if (!(x[i] > 0.0) || !(y[i] > 0.0)) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    mean_x += std::log(x[i]) / n;
    mean_y += std::log(y[i]) / n;
  }
  double xx = 0.0;
  double xy = 0.0;
  for (size_t i = 0; i < x.size(); ++i) {
    const double dx = std::log(x[i]) - mean_x;
    xx += dx * dx;
    xy += dx * (std::log(y[i]) - mean_y);
  }
  return xx > 0.0 ? xy / xx : std::numeric_limits<double>::quiet_NaN();
}

double Percentile(std::vector<double> values, double fraction) {
  EMMY_CHECK(!values.empty() && fraction > 0.0 && fraction <= 1.0,
             values.size() << " values, fraction " << fraction);
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(fraction * static_cast<double>(values.size()));
  return values[static_cast<size_t>(rank) - 1];
}

std::vector<double> PowersOfTen(int first, int last, int increment) {
  std::vector<double> powers;
  for (int i = first; i <= last; i += increment) {
    powers.push_back(std::pow(10.0, i));
  }
  return powers;
}

double ZeroOfCubic(double h, double y0, double slope0, double y1,
                   double slope1) {
  const auto cubic = [&](double s) {
    const double r = 1.0 - s;
    return r * r * ((1.0 + 2.0 * s) * y0 + s * h * slope0) +
           s * s * ((3.0 - 2.0 * s) * y1 - r * h * slope1);
  };
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((cubic(middle) > 0.0) == (y0 > 0.0) ? low : high) = middle;
  }
  return 0.5 * (low + high) * h;
}

}  // namespace emmy::verification
