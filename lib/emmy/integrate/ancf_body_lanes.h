// The step of a free ANCF body with its vectors side by side in SIMD lanes.
//
// The same equations (EM-1) to (EM-6) and the same arithmetic rules as
// AncfBodyStep. Lanes hold e₁, e₂, e₃, three vectors their x, y and z, so that
// a sum over components needs no sum across lanes. With the residual along the
// mean vectors, S the symmetric matrix of the mean stresses,
//   y = det Ē (Ē⁻¹ Δw M + Δt S),  z of (EM-6) for (2 − det Ē) y,    (LANE-1)
// a correction is, D = ½ Ēᵀ Δe without its diagonal and m the antisymmetric
// part, both through (EM-6),
//   Δw −= Ē (z − c ∘ sym(Dᵀ z) − ¼ Δt m(z S))                       (LANE-2)
// What that leaves of an error x is, with τ the largest entry of D,
// μ = 2 τ² + 2 max(‖ε̄‖, ½ ‖Δε‖) and σ = 3/2 Δt² ‖b ε̄‖ ‖(EM-6)⁻¹‖, at most
//   (16 τ² + 6 μ + σ + κ x) x in the strains,
//   (σ (4 τ + σ) + 4 μ² + κ x) x in the rotation,                   (LANE-3)
// so that it is known before the next iteration whether that would be lost in
// rounding. Δe enters the state as a pair of doubles: see docs/theory.md.
//
// For principal body axes and steps that turn a body little; what it does not
// converge to, AncfBodyStep does. The instruction set is chosen when the
// program runs; the bits are the same with every one: lanes are independent,
// and products are rounded before they are added.

#ifndef EMMY_INTEGRATE_ANCF_BODY_LANES_H_
#define EMMY_INTEGRATE_ANCF_BODY_LANES_H_

#include "emmy/base/types.h"
#include "emmy/element/ancf_rigid_body.h"
#include "emmy/integrate/ancf_body_step.h"
#include "emmy/integrate/body_numbers.h"
#include "emmy/model/model.h"
#include "emmy/model/state.h"
#include "emmy/numerics/newton.h"

namespace emmy {

// Constants of a body and a step. Lanes: nothing, e₁, e₂, e₃; of pairs:
// nothing, (e₁, e₂), (e₂, e₃), (e₃, e₁). The first lane is the centre of mass,
// which lies before e₁ in memory and is not moved here.
struct AncfBodyLanes {
  // Of the second moment of mass: whether it is diagonal.
  static bool Fits(const AncfRigidBody& body);

  AncfBodyLanes(const AncfRigidBody& body, double step,
                const NewtonOptions& newton);

  double time_step;
  NewtonOptions options;
  double smallest_moment_sum;               // Of two Mⁱⁱ [kg m²].
  double stiffening;                        // σ/‖Δt b ε̄‖ [1/(J s)]
  double second_order;                      // κ [s]
  alignas(32) double twice_moment[4] = {};  // 2 Mⁱⁱ [kg m²]
  alignas(32) double stretch[4] = {};       // Δt b of the stretches [J s]
  alignas(32) double shear[4] = {};         // Δt b of the pairs [J s]
  // Half the inverse of (EM-6) [1/(kg m²)]: ½/(Mⁱⁱ + cᵢ), and for a pair (m, n)
  // ½ [Mⁿ + c, −c; −c, Mᵐ + c]/determinant.
  alignas(32) double half_inverse[4] = {};
  alignas(32) double half_first[4] = {};           // With Mⁿ, in m's lane.
  alignas(32) double half_second[4] = {};          // With Mᵐ, in n's lane.
  alignas(32) double half_shear[4] = {};           // With c, in m's lane.
  alignas(32) double half_shear_previous[4] = {};  // With c, in n's lane.
  // What the inverse makes of symmetric parts: c/(M + c), and of a pair c Mⁿ
  // and c Mᵐ over the determinant; and of an antisymmetric one (½ Mⁿ + c) and
  // (½ Mᵐ + c) over it [1/(kg m²)]. All in m's lane.
  alignas(32) double stretch_share[4] = {};
  alignas(32) double first_share[4] = {};
  alignas(32) double second_share[4] = {};
  alignas(32) double first_moment[4] = {};
  alignas(32) double second_moment[4] = {};
};

// Increments of a step, in the order of the state: centre (not meaningful, as
// the first number of stretch and shear), e₁, e₂, e₃: Δe [1], Δw [1/s], Δε [1].
struct AncfLanesIncrement {
  double gradients[12] = {};
  double gradients_low[12] = {};  // What the rounding of those drops.
  double rates[12] = {};
  // ε₁ … ε₃ and ε₄ … ε₆, from the second number on.
  double stretch[4] = {};
  double shear[4] = {};

  void Set(const AncfBodyIncrement& increment);
};

// Solves (EM-1) to (EM-3) from the extrapolated start value. The increment is
// meaningful only if the result is kConverged.
BodyStepResult SolveInLanes(const AncfBodyLanes& lanes, const ModelBody& body,
                            const State& state, AncfLanesIncrement* increment);

// Advances the body's part of `state` (SUM-2), and extrapolates the next start
// value. Its centre of mass, which a constant force moves, is solved in closed
// form.
void CommitInLanes(const AncfLanesIncrement& increment, double time_step,
                   const CentreIncrement& centre, const ModelBody& body,
                   State& state);

// Both at once; `state` is not changed unless the result is kConverged.
BodyStepResult AdvanceInLanes(const AncfBodyLanes& lanes,
                              const CentreIncrement& centre,
                              const ModelBody& body, State& state);

}  // namespace emmy

#endif  // EMMY_INTEGRATE_ANCF_BODY_LANES_H_
