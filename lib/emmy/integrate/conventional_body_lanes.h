// The step of a free conventional body in SIMD lanes: (CRB-4) by Newton's
// method on its residual in double-double arithmetic.
//
// In principal axes, with dᵢ = Jₖ − Jⱼ for cyclic i, j, k and the mean
// W̄ = W₀ + ½ ΔW as a pair of doubles,
//   rᵢ = Jᵢ ΔWᵢ + Δt dᵢ W̄ⱼ W̄ₖ,  A x = J⁻¹ r,  ΔW −= x               (CRBL-1)
// where A is the exact Jacobian (CRB-5), divided by J. A start value that is
// extrapolated misses by so little that one correction leaves only
//   3 |Δt d/J| |x|² + 32 u |x|                                     (CRBL-2)
// from what Newton's method neglects and from the rounding of x. ΔW and what
// its rounding to a double drops are both returned, as by ConventionalBodyStep,
// which does what this does not: other axes, and steps that turn a body far.
//
// The bits are the same with every instruction set, as in ancf_body_lanes.h.

#ifndef EMMY_INTEGRATE_CONVENTIONAL_BODY_LANES_H_
#define EMMY_INTEGRATE_CONVENTIONAL_BODY_LANES_H_

#include "emmy/base/types.h"
#include "emmy/element/conventional_rigid_body.h"
#include "emmy/integrate/ancf_body_step.h"
#include "emmy/integrate/body_numbers.h"
#include "emmy/integrate/conventional_body_step.h"
#include "emmy/model/model.h"
#include "emmy/model/state.h"
#include "emmy/numerics/newton.h"

namespace emmy {

// Constants of a body and a step. Lanes: nothing, then the three axes.
struct ConventionalBodyLanes {
  // Whether the inertia tensor is diagonal.
  static bool Fits(const ConventionalRigidBody& body);

  ConventionalBodyLanes(const ConventionalRigidBody& body, double step,
                        const NewtonOptions& newton);

  double time_step;
  NewtonOptions options;
  double largest_gyration;                    // Largest |Δt d/J| [s].
  alignas(32) double moment[4] = {};          // J [kg m²]
  alignas(32) double inverse_moment[4] = {};  // 1/J
  // Δt d as a pair [kg m² s]: its sum over the axes, which would be power out
  // of nothing, vanishes as exactly as that of d.
  alignas(32) double gyration[4] = {};
  alignas(32) double gyration_low[4] = {};
  alignas(32) double half_gyration[4] = {};  // ½ Δt d/J [s]
};

// What a step adds to a body, but for its centre: one in four lanes.
struct ConventionalLanesIncrement {
  double quaternion[4] = {};
  // From the second number on: the first is not meaningful.
  double angular_velocity[4] = {};
  double angular_velocity_low[4] = {};

  void Set(const ConventionalBodyIncrement& increment);
};

// Solves (CRB-4) from the extrapolated start value. The increment is meaningful
// only if the result is kConverged.
BodyStepResult SolveInLanes(const ConventionalBodyLanes& lanes,
                            const ModelBody& body, const State& state,
                            ConventionalLanesIncrement* increment);

// Advances the body's part of `state` (SUM-2), and extrapolates the next start
// value. Its centre of mass, which a constant force moves, is solved in closed
// form.
void CommitInLanes(const ConventionalLanesIncrement& increment,
                   double time_step, const CentreIncrement& centre,
                   const ModelBody& body, State& state);

// Both at once; `state` is not changed unless the result is kConverged.
BodyStepResult AdvanceInLanes(const ConventionalBodyLanes& lanes,
                              const CentreIncrement& centre,
                              const ModelBody& body, State& state);

}  // namespace emmy

#endif  // EMMY_INTEGRATE_CONVENTIONAL_BODY_LANES_H_
