// Richardson's extrapolation of runs whose error is a h² + b h⁴ + ….
//
//   coarse = (4 y(h/2) − y(h)) / 3,  fine = (4 y(h/4) − y(h/2)) / 3
//   finest = (16 fine − coarse) / 15

#ifndef EMMY_VERIFICATION_RUNS_EXTRAPOLATION_H_
#define EMMY_VERIFICATION_RUNS_EXTRAPOLATION_H_

#include <array>
#include <functional>
#include <utility>

#include "absl/status/statusor.h"

namespace emmy::verification {

// `Value`: double, or a matrix.
template <typename Value>
struct Extrapolation {
  std::array<Value, 3> plain;  // With the steps h, h/2 and h/4.
  Value coarse;                // Without the h² term.
  Value fine;                  // Likewise, of half the step.
  Value finest;                // Without the h⁴ term either.
};

// `measure` gives y for a step, or says why it cannot.
template <typename Value>
absl::StatusOr<Extrapolation<Value>> Extrapolate(
    double largest_step,
    const std::function<absl::StatusOr<Value>(double)>& measure) {
  Extrapolation<Value> result;
  double step = largest_step;
  for (Value& plain : result.plain) {
    absl::StatusOr<Value> value = measure(step);
    if (!value.ok()) return value.status();
    plain = *std::move(value);
    step /= 2.0;
  }
  const auto& [whole, half, quarter] = result.plain;
  result.coarse = (4.0 * half - whole) / 3.0;
  result.fine = (4.0 * quarter - half) / 3.0;
  result.finest = (16.0 * result.fine - result.coarse) / 15.0;
  return result;
}

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_RUNS_EXTRAPOLATION_H_
