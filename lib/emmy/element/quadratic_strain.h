// What all elastic parts share: strains quadratic in the coordinates.
//
// For ε(q) = ½ qᵀA q + c and a step from q₀ to q₁ = q₀ + Δq, q̄ = ½(q₀ + q₁):
//   Δε = ε(q₁) − ε(q₀) = (A q̄)·Δq   exactly                        (QS-1)
// A force s A q̄ with the mean stress s = b ε̄, ε̄ = ε₀ + ½ Δε, does the work
//   s (A q̄)·Δq = b ε̄ Δε = Δ(½ b ε²)   exactly                      (QS-2)
// so that energy is kept without a difference quotient. If ε is invariant
// under rotation, Σ q̄ × (s A q̄) = 0: angular momentum is kept. The strain is
// carried in the state and advanced by (QS-1); recomputed from q it would
// cancel, and b would multiply what is left.
//
// Source: Simo and Tarnow, ZAMP 43 (1992); Gonzalez, J. Nonlinear Sci. 6
// (1996).

#ifndef EMMY_ELEMENT_QUADRATIC_STRAIN_H_
#define EMMY_ELEMENT_QUADRATIC_STRAIN_H_

#include "emmy/base/types.h"

namespace emmy {

// (QS-1) for ε = ½ (a·a − constant).
inline double NormalStrainIncrement(const Vector3d& a_mean,
                                    const Vector3d& a_increment) {
  return a_mean.dot(a_increment);
}

// (QS-1) for ε = a·b.
inline double ProductStrainIncrement(const Vector3d& a_mean,
                                     const Vector3d& a_increment,
                                     const Vector3d& b_mean,
                                     const Vector3d& b_increment) {
  return a_mean.dot(b_increment) + b_mean.dot(a_increment);
}

}  // namespace emmy

#endif  // EMMY_ELEMENT_QUADRATIC_STRAIN_H_
