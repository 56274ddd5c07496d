// One energy-momentum step of ANCF bodies joined at shared points.
//
// The equations (EM-9), the arithmetic and the stop rule are those of
// CoupledStep, and so is the solution, up to round-off. What differs is the
// correction: the bodies are eliminated by their tangents, constant (EM-6) or,
// in a chain, to first order in turn and strain (EM-17), and a small system for
// the joint forces is left (EM-14).
//
// Where that does not converge (large steps, soft penalties), the whole step is
// done again by CoupledStep.

#ifndef EMMY_INTEGRATE_JOINT_STEP_H_
#define EMMY_INTEGRATE_JOINT_STEP_H_

#include <cstdint>
#include <memory>
#include <string>

#include "emmy/integrate/ancf_body_step.h"
#include "emmy/integrate/coupled_step.h"
#include "emmy/integrate/structure.h"
#include "emmy/model/state.h"

namespace emmy {

class JointSystem;

class JointStep {
 public:
  // Null if `structure`, which must outlive the step, has other parts than
  // ANCF bodies in principal axes, joined by shared points.
  static std::unique_ptr<JointStep> Create(const Structure& structure,
                                           double time_step,
                                           const CoupledStepOptions& options,
                                           int num_threads);
  ~JointStep();

  // Solves (EM-9); `state` is not changed.
  BodyStepResult Solve(const State& state);

  // Advances `state` by the last solution, except its time.
  void Commit(State& state);

  // The part with the largest residual, after a step that failed.
  std::string WorstPart() const;

  // What is kept from step to step, and back to it; see CoupledTangent.
  KeptTangent Keep() const;
  bool Restore(const KeptTangent& kept);

  int num_factorizations() const;

 private:
  JointStep(const Structure& structure, double time_step,
            const CoupledStepOptions& options,
            std::unique_ptr<JointSystem> system);

  BodyStepResult Iterate();
  void Age(int iterations, bool is_fresh);

  const Structure* structure_;
  double time_step_;
  CoupledStepOptions options_;
  std::unique_ptr<JointSystem> system_;
  // Made when it is first needed.
  std::unique_ptr<CoupledStep> coupled_;
  bool used_coupled_ = false;
  int last_iterations_ = 0;
  // See KeptTangent.
  int64_t fewest_iterations_ = 0;
  int64_t excess_iterations_ = 0;
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_JOINT_STEP_H_
