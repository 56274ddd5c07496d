// One energy-momentum step of the gradient vectors of a free ANCF body.
//
// Unknown: the velocity increments Δw, columns for e₁, e₂, e₃.
//   Δe = Δt (w₀ + ½ Δw),  ē = e₀ + ½ Δe                            (EM-1)
//   Mⁱʲ Δwⱼ + Δt f̄ᵢ = 0,  f̄ = (ANCF-6) with ē and ε̄              (EM-2)
//   Δε = (A ē)·Δe,  ε̄ = ε₀ + ½ Δε                                  (EM-3)
// Kept exactly for any Δt and b, up to the residual: ½ w·Mw + ½ Σ b ε² and
// Mⁱʲ eᵢ × wⱼ. The arithmetic: no position difference is divided by Δt, the
// strain is not recomputed, the compensations of w₀, e₀ and ε₀ enter (EM-1)
// to (EM-3), and the iteration runs to round-off (EM-5).
//
// Source: Simo and Tarnow, ZAMP 43 (1992), with the strain carried.

#ifndef EMMY_INTEGRATE_ANCF_BODY_STEP_H_
#define EMMY_INTEGRATE_ANCF_BODY_STEP_H_

#include "emmy/base/types.h"
#include "emmy/element/ancf_rigid_body.h"
#include "emmy/integrate/corotated_tangent.h"
#include "emmy/numerics/newton.h"

namespace emmy {

// Values and compensations at the start of the step.
struct AncfBodyStart {
  Matrix3d gradients;
  Matrix3d gradients_compensation;
  Matrix3d rates;
  Matrix3d rates_compensation;
  Vector6d strain;
  Vector6d strain_compensation;
};

// What a step adds to a body, but for its centre.
struct AncfBodyIncrement {
  Matrix3d gradients = Matrix3d::Zero();  // Δe
  Matrix3d rates = Matrix3d::Zero();      // Δw
  Vector6d strain = Vector6d::Zero();     // Δε
};

// How the iteration of a step of one body ended.
struct [[nodiscard]] BodyStepResult {
  Termination termination = Termination::kMaxIterations;
  int iterations = 0;
  double correction = 0.0;  // Largest entry of the last one.
};

class AncfBodyStep {
 public:
  // Which Jacobian is used. kAutomatic starts with M alone where ¼ Δt² b is
  // far below it (a soft penalty, whose strains spoil the frame of (EM-6)),
  // else with (EM-6), and goes over to kFullNewton where that is slow.
  enum class Tangent { kAutomatic, kFullNewton };

  AncfBodyStep(const AncfRigidBody& body, double time_step,
               const NewtonOptions& options,
               Tangent tangent = Tangent::kAutomatic);

  // Solves (EM-1) to (EM-3) from the start value `rate_increment_guess`. The
  // increment is meaningful only if the result is kConverged. No allocation.
  BodyStepResult Solve(const AncfBodyStart& start,
                       const Matrix3d& rate_increment_guess,
                       AncfBodyIncrement* increment) const;

  // Whether ¼ Δt² b is not far below M, so that (EM-6) is the tangent.
  bool penalty_dominates() const { return !mass_dominates_; }

 private:
  struct Evaluation;

  Evaluation Evaluate(const AncfBodyStart& start,
                      const Matrix3d& rate_increment) const;
  bool FullNewtonCorrection(const Evaluation& evaluation,
                            Matrix3d* correction) const;
  Matrix3d RigidTurnGuess(const AncfBodyStart& start) const;
  BodyStepResult Iterate(const AncfBodyStart& start, bool full_newton,
                         Matrix3d* rate_increment) const;

  AncfRigidBody body_;
  double time_step_;
  NewtonOptions options_;
  Tangent tangent_;
  CorotatedTangent corotated_;
  Matrix3d inverse_moment_;     // (Mⁱʲ)⁻¹
  double smallest_moment_sum_;  // Of two principal second moments [kg m²].
  bool mass_dominates_;         // ¼ Δt² b is far below M.
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_ANCF_BODY_STEP_H_
