// One energy-momentum step of a structure: ANCF bodies, nodes, trusses,
// cables and springs, tied by constraints, under loads.
//
// Unknown: the velocity increments Δw of the vector coordinates and, for
// constraints G q = const, the joint forces λ [N]:
//   Δq = Δt (w₀ + ½ Δw),  q̄ = q₀ + ½ Δq                            (EM-1)
//   M Δw + Δt (f̄ − F̄ + Gᵀ λ) = 0,  G w̄ = 0                         (EM-9)
// with the work-exact forces of (ANCF-6) and (LINE-2). G is constant, so that
// G Δq = 0 makes Gᵀ λ do no work and exert no net force or moment: all laws
// stay exact whatever λ is. A torque τ acts on the gradient vectors of a body
// as fᵢ = ½ τ × ēⁱ, ēⁱ the dual vectors, so that Σ ēᵢ × fᵢ = τ.      (EM-12)
//
// The residual is exact and iterated to round-off; corrections come from a
// kept symmetric tangent, [K, Gᵀ; G, −κ] [δw; δ(Δt λ)] = [r; 2 G w̄]   (EM-10)
// (see coupled_tangent.h), renewed only when convergence slows, or in every
// step where it is dense and cheap. κ > 0 is small, so that nearly dependent
// joints do no harm.

#ifndef EMMY_INTEGRATE_COUPLED_STEP_H_
#define EMMY_INTEGRATE_COUPLED_STEP_H_

#include <memory>
#include <optional>
#include <string>

#include "emmy/base/types.h"
#include "emmy/base/work_team.h"
#include "emmy/integrate/ancf_body_step.h"
#include "emmy/integrate/coupled_tangent.h"
#include "emmy/integrate/lined_body_lanes.h"
#include "emmy/integrate/structure.h"
#include "emmy/integrate/structure_lines.h"
#include "emmy/integrate/vector_blocks.h"
#include "emmy/model/state.h"
#include "emmy/numerics/newton.h"
#include "emmy/numerics/symmetric_factor.h"

namespace emmy {

// How the equations of a structure are solved.
struct CoupledStepOptions {
  NewtonOptions newton;
  SymmetricFactor::Method method = SymmetricFactor::Method::kAutomatic;
  // For comparison: a fresh factorisation in every iteration.
  bool always_factorize = false;
  // At least 1. The bits do not depend on it.
  int num_threads = 1;
};

class CoupledStep {
 public:
  // `structure` must outlive the step.
  CoupledStep(const Structure& structure, double time_step,
              const CoupledStepOptions& options);

  // Solves (EM-9); `state` is not changed.
  BodyStepResult Solve(const State& state);

  // Advances `state` by the last solution, except its time.
  void Commit(State& state) const;

  // The body, line or node with the largest residual in the last iteration.
  std::string WorstPart() const;

  // What is kept from step to step, and back to it; see CoupledTangent.
  KeptTangent Keep() const { return renew_ ? KeptTangent{} : tangent_.Keep(); }
  bool Restore(const KeptTangent& kept);

  int num_factorizations() const { return tangent_.num_factorizations(); }

 private:
  // What must vanish: largest entries of the net force and moment of the
  // residual [kg m/s, kg m²/s], and its work [J].
  struct Laws {
    double force, moment, work;
  };
  // Sizes that rounding alone gives to a correction and to these.
  struct Floors {
    double rate, force, moment, work;
  };

  Eigen::Index MultiplierOffset(Eigen::Index constraint) const;
  void Load(const State& state);
  template <typename Work>
  void ForVectors(const Work& work);
  void EvaluateInertia();
  void Evaluate();
  void EvaluateBodies();
  void EvaluateLoads();
  void EvaluateConstraints();
  void AdvanceLines();
  bool Renew();
  bool SolveCorrection(bool exact);
  BodyStepResult Iterate(bool exact, bool near);
  BodyStepResult IterateAndCheck(bool exact, bool near = false);
  BodyStepResult IterateAndFinish();
  double ResidualWork() const;
  Laws MeasureLaws() const;
  bool LawsHold() const;
  bool KeepsEnergy() const;
  double LoadWork() const;
  void GuessRigidTurn();
  Floors RoundingFloors() const;
  TangentPoint Point() const {
    return {mean_, lines_.mean(), lines_.tension(), lines_.derivative()};
  }

  const Structure* structure_;
  double time_step_;
  CoupledStepOptions options_;
  CoupledTangent tangent_;
  bool renew_ = true;
  std::unique_ptr<WorkTeam> team_;
  BlockedItems<Structure::Mass> masses_;  // Entries of the mass matrix.
  std::optional<LinedBodyLanes> lanes_;   // Tried first, where it fits.

  // The start of the step.
  Matrix3Xd q0_, q0_compensation_, w0_, w0_compensation_;
  VectorXd strain0_, strain0_compensation_;
  // The iterate, and what follows from it.
  Matrix3Xd dw_, mean_rate_, dq_, mean_, end_, residual_;
  VectorXd magnitude_;  // Sum of the sizes of a residual's terms.
  Matrix3Xd impulse_, constraint_rate_;  // Δt λ [N s], G w̄.
  StructureLines lines_;
  VectorXd strain_increment_;
  // Corrections.
  Matrix3Xd correction_, impulse_correction_;
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_COUPLED_STEP_H_
