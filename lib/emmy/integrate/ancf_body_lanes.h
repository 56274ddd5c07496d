// The step of a free ANCF body with its vectors side by side in SIMD lanes.
//
// The same equations (EM-1) to (EM-6) and the same arithmetic rules as
// AncfBodyStep. Lanes hold e₁, e₂, e₃, three vectors their x, y and z, so that
// a sum over components needs no sum across lanes. Residual and correction are
// both taken along the dual vectors ēⁱ of the mean gradients:
//   Δw −= ēʲ xᵢⱼ,  x of (EM-6) for yᵢⱼ = ēʲ·rᵢ                      (LANE-1)
// What is left of an error x after a correction, with τ = ½ Δt ‖w̄‖, is
//   2 τ x in the strains, which are those of the end of the step,
//   (τ² + ‖ε̄‖ + ¼ Δt² ‖b ε̄‖/(Mᵐ + Mⁿ)) x in the rotation,           (LANE-2)
// since the frame is not quite orthonormal and the stress is left out. So it
// is known before the next iteration whether that would be lost in rounding.
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
  alignas(32) double twice_moment[4] = {};  // 2 Mⁱⁱ [kg m²]
  alignas(32) double stretch[4] = {};       // b of the stretches [J]
  alignas(32) double shear[4] = {};         // b of the pairs [J]
  // Half the inverse of (EM-6) [1/(kg m²)]: ½/(Mⁱⁱ + cᵢ), and for a pair (m, n)
  // ½ [Mⁿ + c, −c; −c, Mᵐ + c]/determinant.
  alignas(32) double half_inverse[4] = {};
  alignas(32) double half_first[4] = {};           // With Mⁿ, in m's lane.
  alignas(32) double half_second[4] = {};          // With Mᵐ, in n's lane.
  alignas(32) double half_shear[4] = {};           // With c, in m's lane.
  alignas(32) double half_shear_previous[4] = {};  // With c, in n's lane.
};

// Increments of a step, in the order of the state: centre (not meaningful), e₁,
// e₂, e₃.
struct AncfLanesIncrement {
  double gradients[12] = {};
  double rates[12] = {};
  // ε₁ … ε₆ from the second number on.
  double strain[8] = {};

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
                   const Vector3d& gravity, const ModelBody& body,
                   State& state);

}  // namespace emmy

#endif  // EMMY_INTEGRATE_ANCF_BODY_LANES_H_
