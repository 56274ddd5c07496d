// The plane mathematical pendulum, released at rest, in closed form.
//
//   l θ̈ = −g sin θ,  θ(0) = θ₀,  θ̇(0) = 0;  θ = 0 hangs down.       (PEN-1)
//   m = sin²(½ θ₀),  τ = √(g / l) t;  sn, cn, dn of (τ | m):
//   sin(½ θ) = sin(½ θ₀) cn / dn,   cos(½ θ) = |cos(½ θ₀)| / dn       (PEN-2)
//   θ̇ = −√(g / l) sin θ₀ sn / dn                           [rad/s]   (PEN-3)
//   period T = 4 K(m) √(l / g)                              [s]       (PEN-4)
//
// From the horizontal, θ₀ = ±½ π: m = ½, K = 1.854074677….
//
// Valid for |θ₀| < π. Error: a few u (1 + τ), u the unit round-off of T.
//
// Derivation: docs/theory.md (PEN-1..4), after Whittaker, Analytical
// Dynamics, §44; DLMF 22.19(i). Not modelled: elasticity, turning over.

#ifndef EMMY_VERIFICATION_EXACT_PENDULUM_H_
#define EMMY_VERIFICATION_EXACT_PENDULUM_H_

#include "verification/exact/jacobi_elliptic.h"
#include "verification/exact/real.h"

namespace emmy::exact {

template <typename T>
class Pendulum {
 public:
  struct State {
    T angle;             // θ [rad], in (−π, π)
    T angular_velocity;  // θ̇ [rad/s]
    T x;                 // l sin θ, sideways [m]
    T y;                 // −l cos θ, upwards from the pivot [m]
  };

  // `length` l [m] and `gravity` g [m/s²] > 0; |release_angle| < π [rad].
  Pendulum(const T& length, const T& gravity, const T& release_angle);

  State At(const T& time) const;  // Any finite time [s].
  T Period() const;               // (PEN-4) [s]

 private:
  T length_;
  T frequency_;    // √(g / l)
  T half_sine_;    // sin(½ θ₀)
  T half_cosine_;  // cos(½ θ₀)
  JacobiFunctions<T> functions_;
};

}  // namespace emmy::exact

#endif  // EMMY_VERIFICATION_EXACT_PENDULUM_H_
