// The step of an ANCF body with up to four trusses, cables or springs, each to
// a node of its own, in SIMD lanes: the paper's box and truss.
//
// The equations are those of CoupledStep, (EM-1), (EM-9) without joints, and
// its rules for round-off but for that of the laws; the lanes are those of
// ancf_body_lanes.h, with the centre of mass before the three vectors, and four
// more for the nodes and lines. Along the mean dual vectors ēᵏ the tangent
// without lines is one constant,
//   K₀ = M ⊗ 1 + ¼ Δt² Σ b g gᵀ,  B = K₀⁻¹,                         (LANE-4)
// computed once, and a line adds c ĝ ĝᵀ, c = ½ Δt² t', ĝ = a ⊗ (ēᵏ·d̄) for its
// weights a, which the identity of Woodbury solves with one number a line:
//   x = z − Σ h μ,  z = B y,  h = B ĝ,  (c⁻¹ + ĝᵀ h) μ = ĝᵀ z         (LANE-5)
// Force, moment and work are not seen to vanish where the last correction says
// that they do (LANE-6): five iterations a step of the paper's box and truss
// instead of six or seven.
// The tension's own stiffness is left out, so that a line whose tension moves
// its node far in a step is not solved; CoupledStep does that.

#ifndef EMMY_INTEGRATE_LINED_BODY_LANES_H_
#define EMMY_INTEGRATE_LINED_BODY_LANES_H_

#include <memory>
#include <vector>

#include "emmy/base/types.h"
#include "emmy/element/line_element.h"
#include "emmy/integrate/ancf_body_step.h"
#include "emmy/integrate/structure.h"
#include "emmy/model/state.h"
#include "emmy/numerics/newton.h"

namespace emmy {

class LinedBodyLanes {
 public:
  static constexpr int kMaxLines = 4;

  // Whether `structure` is one body in mid-air with one to four lines, each
  // from the body to a node of its own, without joints, forces and torques.
  static bool Fits(const Structure& structure);

  // `structure` must fit, and outlive this.
  LinedBodyLanes(const Structure& structure, double time_step,
                 const NewtonOptions& options);

  // Solves from the extrapolated start value, without allocation. The columns
  // of vectors Δw and Δq and the strain increments are meaningful only if the
  // result is kConverged.
  BodyStepResult Solve(const State& state, Matrix3Xd* dw, Matrix3Xd* dq,
                       VectorXd* strain_increment) const;

  // All numbers of the tangent and the residual, by lanes; see the source.
  struct Constants;

 private:
  const Structure* structure_;
  std::shared_ptr<const Constants> constants_;
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_LINED_BODY_LANES_H_
