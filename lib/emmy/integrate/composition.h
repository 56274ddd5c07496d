// Steps of order four and six, composed of second-order steps.
//
//   Ψ_h = Φ_{h/2} Φ_{h/2}                                          (COMP-1)
//   Φ⁽⁴⁾, Φ⁽⁶⁾ = Ψ_{γ₁Δt} … Ψ_{γ₂Δt} Ψ_{γ₁Δt}, a palindrome       (COMP-2)
// with Φ the energy-momentum step. Some γ are negative: those parts go back in
// time. Every law that Φ keeps for steps of any size and sign is kept.
//
// In pairs, because a stiff penalty turns strain rates round in every step:
// see docs/theory.md. Coefficients:
//   four: Suzuki, Phys. Lett. A 146 (1990) 319, five Ψ              (COMP-3)
//   six:  Kahan and Li, Math. Comp. 66 (1997) 1089, "s9odr6a", nine Ψ;
//         digits as in Hairer, Lubich and Wanner, Geometric Numerical
//         Integration, 2nd ed., (V.3.12)                           (COMP-4)

#ifndef EMMY_INTEGRATE_COMPOSITION_H_
#define EMMY_INTEGRATE_COMPOSITION_H_

#include <vector>

namespace emmy {

// Whether there is a composition of this order: 2, 4, 6.
bool IsCompositionOrder(int order);

// The sizes of the steps Φ that make one of size `time_step` [s], in their
// sequence: 1, 10 or 18 of them. A palindrome whose exact sum is `time_step`;
// those for −Δt are the negatives. `order` must be one there is, `time_step`
// normal.
std::vector<double> SubSteps(int order, double time_step);

}  // namespace emmy

#endif  // EMMY_INTEGRATE_COMPOSITION_H_
