#include "emmy/integrate/composition.h"

#include <cmath>

#include "emmy/base/check.h"

namespace emmy {
namespace {

// γ₁, γ₂, … up to the middle one, which is what is left to one.
std::vector<double> OuterWeights(int order) {
  switch (order) {
    case 4:  // 1/(4 − ∛4)
      return {0.41449077179437573714235406, 0.41449077179437573714235406};
    case 6:
      return {0.39216144400731413927925056, 0.33259913678935943859974864,
              -0.70624617255763935980996482, 0.08221359629355080023149045};
    default:
      return {};
  }
}

// γ Δt as a multiple of the last place of Δt, so that sums do not round.
double Part(double weight, double time_step) {
  int exponent = 0;
  std::frexp(time_step, &exponent);
  constexpr int kDigits = 53;
  return std::ldexp(
      std::nearbyint(std::ldexp(weight * time_step, kDigits - exponent)),
      exponent - kDigits);
}

}  // namespace

bool IsCompositionOrder(int order) {
  return order == 2 || order == 4 || order == 6;
}

std::vector<double> SubSteps(int order, double time_step) {
  EMMY_CHECK(IsCompositionOrder(order), "order " << order);
  if (order == 2) return {time_step};
  std::vector<double> outer;
  double middle = time_step;
  for (const double weight : OuterWeights(order)) {
    const double part = Part(weight, time_step);
    outer.insert(outer.end(), 2, 0.5 * part);
    middle -= part;
    middle -= part;
  }
  std::vector<double> steps = outer;
  steps.insert(steps.end(), 2, 0.5 * middle);
  steps.insert(steps.end(), outer.rbegin(), outer.rend());
  return steps;
}

}  // namespace emmy
