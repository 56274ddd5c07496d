// Elastic line between two points: Green–Lagrange truss, cable, linear spring.
//
//   d = x₂ − x₁,  s = ½ d·d,  Δs = d̄·Δd  exactly                  (LINE-1)
// s is a quadratic strain (quadratic_strain.h). Each kind carries a scalar y,
// a function of s alone, and has an energy W(y). With the tension factor
//   t = ΔW / Δs,   force on d:  f̄ = t d̄                           (LINE-2)
// a step does exactly the work f̄·Δd = ΔW, and d̄ × f̄ = 0 keeps angular
// momentum. The quotient is never formed: each kind has it in closed form.
//
//   Truss  (natural length L, axial stiffness EA, Green–Lagrange strain)
//     y = ε = (d·d − L²) / (2 L²),  W = ½ EA L ε²
//     Δε = Δs / L²,  t = (EA/L) ε̄                                  (LINE-3)
//   Cable: the same without compression, W = ½ EA L max(ε, 0)²
//     ΔW/Δε = ½ EA L (ε₁₊² − ε₀₊²)/(ε₁ − ε₀), case by case         (LINE-4)
//   Spring (natural length L, stiffness k, true length l)
//     y = l − L,  W = ½ k y²,  l₁² − l₀² = 2 Δs
//     Δy = 2 Δs / (l₀ + l₁),  t = 2 k ȳ / (l₀ + l₁)                (LINE-5)
//
// y is carried with its compensation and advanced by Δy. Units: d [m],
// t [N/m]; y [-] for truss and cable, [m] for the spring.
// Source for (LINE-3): Simo and Tarnow, ZAMP 43 (1992).
// Not covered: bending, change of section, a spring whose ends pass through
// one another within a step (its force has no direction there).

#ifndef EMMY_ELEMENT_LINE_ELEMENT_H_
#define EMMY_ELEMENT_LINE_ELEMENT_H_

#include "emmy/base/double_double.h"
#include "emmy/base/export.h"

namespace emmy {

class EMMY_EXPORT LineElement {
 public:
  // Which of the laws above.
  enum class Kind {
    kTruss,   // (LINE-3)
    kCable,   // (LINE-4)
    kSpring,  // (LINE-5)
  };

  // (LINE-3) from L [m] and EA [N], both finite and positive; not checked.
  static LineElement Truss(double natural_length, double axial_stiffness);
  // (LINE-4) from the same.
  static LineElement Cable(double natural_length, double axial_stiffness);
  // (LINE-5) from L [m], finite and not negative, and k [N/m], finite and
  // positive; not checked.
  static LineElement Spring(double natural_length, double stiffness);

  // How a line answers to Δs.
  struct Response {
    double increment;       // Δy: [-], or [m] of a spring.
    double tension_factor;  // t of (LINE-2) [N/m]
    double derivative;      // dt/dΔs [N/m³], for the tangent only.
  };

  // (LINE-3) by itself: a net asks it of every truss in every iteration.
  struct TrussLaw {
    double inverse_square = 0.0;  // 1/L² [1/m²]
    double factor = 0.0;          // EA/L [N/m]

    // Δε for Δs [m²].
    double Increment(double ds) const { return inverse_square * ds; }
    // t [N/m] with the mean of ε₀ = value + compensation and ε₁ = ε₀ +
    // increment.
    double TensionFactor(double value, double compensation,
                         double increment) const {
      return factor * (value + (compensation + 0.5 * increment));
    }
  };

  // Response to Δs from the value y₀ and its compensation.
  Response Respond(double value, double compensation, double ds) const {
    if (kind_ == Kind::kCable) return RespondAsCable(value, compensation, ds);
    if (kind_ == Kind::kSpring) return RespondAsSpring(value, compensation, ds);
    const double increment = law_.Increment(ds);
    return {increment, law_.TensionFactor(value, compensation, increment),
            derivative_};
  }

  // y for the distance `d` between the ends, in extended precision.
  DoubleDouble Value(const DoubleDouble3& d) const;

  // W(y) [J]
  DoubleDouble Energy(const DoubleDouble& value) const;

  // What the results call strain: ε; for a spring the extension over the
  // natural length, or the length [m] itself where the natural length is 0.
  double Strain(double value) const;

  // Tension [N], the force along d: EA ε l/L, zero for a slack cable; k y.
  double Tension(double value) const;

  Kind kind() const { return kind_; }                 // Truss, cable, spring.
  double natural_length() const { return length_; }   // L [m]
  double stiffness() const { return stiffness_; }     // EA [N]; k [N/m].
  const TrussLaw& truss_law() const { return law_; }  // Not of springs.

 private:
  LineElement(Kind kind, double length, double stiffness);

  Response RespondAsCable(double value, double compensation, double ds) const;
  Response RespondAsSpring(double value, double compensation, double ds) const;

  Kind kind_;
  double length_;
  double stiffness_;
  TrussLaw law_;                     // Truss and cable.
  double energy_coefficient_ = 0.0;  // EA L
  double derivative_ = 0.0;          // EA/(2 L³)
};

}  // namespace emmy

#endif  // EMMY_ELEMENT_LINE_ELEMENT_H_
