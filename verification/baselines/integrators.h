// The usual integrators of structural dynamics, as their textbooks give them,
// in plain arithmetic, each equation solved by Newton's method with the exact
// Jacobian. State: q, w = q̇ and, where the method needs it, a.
//
// Generalised α, unknown a₁:
//   M a_{1−αm} + f_{1−αf} = 0,  x_{1−α} = (1 − α) x₁ + α x₀
//   q₁ = q₀ + Δt w₀ + Δt² ((½ − β) a₀ + β a₁)
//   w₁ = w₀ + Δt ((1 − γ) a₀ + γ a₁)                               (BASE-3)
//   αm = (2ρ − 1)/(ρ + 1), αf = ρ/(ρ + 1), γ = ½ − αm + αf,
//   β = ¼ (1 − αm + αf)²                                           (BASE-4)
// so that the spectral radius of a linear vibration tends to ρ for Δt Ω → ∞.
// Newmark's average acceleration, the trapezoidal rule: αm = αf = 0,
// β = ¼, γ = ½.
//
// Implicit midpoint, unknown w₁:
//   M (w₁ − w₀) + Δt f(q̄) = 0,  q₁ = q₀ + ½ Δt (w₀ + w₁)          (BASE-5)
//
// Velocity Verlet, explicit, stable for Δt Ω < 2:
//   q₁ = q₀ + Δt w₀ + ½ Δt² a₀,  M a₁ = −f(q₁),
//   w₁ = w₀ + ½ Δt (a₀ + a₁)                                       (BASE-6)
//
// Sources: Newmark, J. Eng. Mech. Div. ASCE 85 (1959); Chung and Hulbert,
// J. Appl. Mech. 60 (1993), with the weighted mean of the forces for f_{1−αf};
// Hairer, Lubich and Wanner, Geometric Numerical Integration (2006).

#ifndef EMMY_VERIFICATION_BASELINES_INTEGRATORS_H_
#define EMMY_VERIFICATION_BASELINES_INTEGRATORS_H_

#include "emmy/base/types.h"
#include "emmy/numerics/newton.h"
#include "verification/baselines/elastic_system.h"

namespace emmy::verification {

struct Motion {
  VectorXd position;      // q
  VectorXd velocity;      // w
  VectorXd acceleration;  // a; see StartMotion.
};

// With a from M a = −f(q).
Motion StartMotion(const ElasticSystem& system, const VectorXd& position,
                   const VectorXd& velocity);

// Of (BASE-3).
struct GeneralizedAlpha {
  double alpha_m = 0.0;
  double alpha_f = 0.0;
  double beta = 0.25;
  double gamma = 0.5;

  static GeneralizedAlpha AverageAcceleration() { return {}; }
  static GeneralizedAlpha WithSpectralRadius(double rho);  // (BASE-4)
};

// Each advances `motion` by one step, and leaves it alone unless the report is
// ok. An iteration has converged when the largest correction of q is 1e-11 of
// the largest |q|: the next one would be its square, below round-off.
StepReport StepGeneralizedAlpha(const ElasticSystem& system, double time_step,
                                const GeneralizedAlpha& parameters,
                                Motion* motion);
StepReport StepMidpoint(const ElasticSystem& system, double time_step,
                        Motion* motion);
StepReport StepVerlet(const ElasticSystem& system, double time_step,
                      Motion* motion);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_BASELINES_INTEGRATORS_H_
