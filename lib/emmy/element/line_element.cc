#include "emmy/element/line_element.h"

#include <algorithm>
#include <cmath>

namespace emmy {

LineElement::LineElement(Kind kind, double length, double stiffness)
    : kind_(kind), length_(length), stiffness_(stiffness) {
  if (kind == Kind::kSpring) return;
  energy_coefficient_ = stiffness * length;
  law_.inverse_square = 1.0 / (length * length);
  law_.factor = energy_coefficient_ * law_.inverse_square;
  derivative_ = 0.5 * law_.factor * law_.inverse_square;
}

LineElement LineElement::Truss(double natural_length, double axial_stiffness) {
  return {Kind::kTruss, natural_length, axial_stiffness};
}

LineElement LineElement::Cable(double natural_length, double axial_stiffness) {
  return {Kind::kCable, natural_length, axial_stiffness};
}

LineElement LineElement::Spring(double natural_length, double stiffness) {
  return {Kind::kSpring, natural_length, stiffness};
}

LineElement::Response LineElement::RespondAsCable(double value,
                                                  double compensation,
                                                  double ds) const {
  const double increment = law_.Increment(ds);
  const double start = value + compensation;
  const double end = value + (compensation + increment);
  if (start >= 0.0 && end >= 0.0) {
    return {increment, law_.TensionFactor(value, compensation, increment),
            derivative_};
  }
  if (start <= 0.0 && end <= 0.0) return {increment, 0.0, 0.0};
  // Across zero, ε₀ ε₁ < 0, so that the increment cannot be small against
  // the strain that counts.
  if (end > 0.0) {
    const double share = end / increment;  // Of the step spent taut.
    return {increment, law_.factor * (0.5 * end * share),
            derivative_ * share * (2.0 - share)};
  }
  const double share = -start / increment;
  return {increment, law_.factor * (0.5 * start * share),
          derivative_ * share * share};
}

LineElement::Response LineElement::RespondAsSpring(double value,
                                                   double compensation,
                                                   double ds) const {
  const double l0 = length_ + (value + compensation);
  // Rounding may take the square below zero where the spring has no length.
  const double l1 = std::sqrt(std::max(0.0, l0 * l0 + 2.0 * ds));
  const double sum = l0 + l1;
  if (!(sum > 0.0)) return {0.0, 0.0, 0.0};
  const double increment = 2.0 * ds / sum;
  const double mean = value + (compensation + 0.5 * increment);
  // t = k (1 − 2L/(l₀ + l₁)) without its cancellation.
  const double derivative =
      l1 > 0.0 ? 2.0 * stiffness_ * length_ / (sum * sum * l1) : 0.0;
  return {increment, 2.0 * stiffness_ * mean / sum, derivative};
}

DoubleDouble LineElement::Value(const DoubleDouble3& d) const {
  if (kind_ == Kind::kSpring) return Norm(d) - DoubleDouble(length_);
  const DoubleDouble square(TwoProduct(length_, length_));
  return (Dot(d, d) - square) / (DoubleDouble(2.0) * square);
}

DoubleDouble LineElement::Energy(const DoubleDouble& value) const {
  if (kind_ == Kind::kSpring) {
    return DoubleDouble(0.5 * stiffness_) * (value * value);
  }
  if (kind_ == Kind::kCable && value.hi < 0.0) return {};
  return DoubleDouble(0.5 * energy_coefficient_) * (value * value);
}

double LineElement::Strain(double value) const {
  if (kind_ != Kind::kSpring) return value;
  return length_ > 0.0 ? value / length_ : value;
}

double LineElement::Tension(double value) const {
  if (kind_ == Kind::kSpring) return stiffness_ * value;
  if (kind_ == Kind::kCable && value < 0.0) return 0.0;
  // l/L = √(1 + 2 ε).
  return stiffness_ * value * std::sqrt(std::max(0.0, 1.0 + 2.0 * value));
}

}  // namespace emmy
