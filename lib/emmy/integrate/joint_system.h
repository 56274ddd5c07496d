// The linear algebra of bodies joined at shared points, as JointStep sees it.

#ifndef EMMY_INTEGRATE_JOINT_SYSTEM_H_
#define EMMY_INTEGRATE_JOINT_SYSTEM_H_

#include <cstddef>
#include <optional>

#include "emmy/base/types.h"
#include "emmy/integrate/coupled_tangent.h"
#include "emmy/integrate/joint_chain_kernel.h"
#include "emmy/model/state.h"

namespace emmy {

// What the laws forbid to remain of a residual, and the scales of rounding.
struct JointSums {
  Vector3d force = Vector3d::Zero();
  Vector3d moment = Vector3d::Zero();
  double work = 0.0;
  // Sums of squares of the terms' sizes, and largest rate.
  double force_size = 0.0;
  double moment_size = 0.0;
  double work_size = 0.0;
  double rate = 0.0;
  // Energy of the start, and work of weight and loads in this step [J].
  double energy = 0.0;
  double load_work = 0.0;
};

// The corrections of all velocities in one iteration.
struct JointCorrection {
  double largest = 0.0;  // Of |δw|.
  bool is_finite = false;
};

// Sums over the pieces of `groups` groups, in their order.
void AddPieceSums(ForwardWork work, const double* pieces, size_t groups,
                  JointSums* sums);
JointCorrection PieceCorrection(const double* pieces, size_t groups);

class JointSystem {
 public:
  virtual ~JointSystem() = default;

  // Takes the start of a step, and the start values of its iteration; `state`
  // must stay as it is until the first Evaluate, which is with kFactorize.
  virtual void Load(const State& state) = 0;

  // Residual of the iterate, and the bodies' part of the correction. What
  // `work` leaves out of the sums is as it was before.
  virtual const JointSums& Evaluate(ForwardWork work) = 0;

  // Solves (EM-14) and corrects the iterate. If `next` is given, an Evaluate
  // with it is likely to follow, and may be done at once.
  virtual JointCorrection Correct(std::optional<ForwardWork> next) = 0;

  // A matrix kept from an earlier step is made anew by the next Evaluate with
  // kFactorize or, in a step, at once; false if none was kept.
  virtual bool Renew() { return false; }

  // Nothing is kept for the next step.
  virtual void Forget() {}

  // What is kept from step to step, and back to it; see CoupledTangent.
  virtual KeptTangent Keep() const { return {}; }
  virtual bool Restore(const KeptTangent& kept) {
    return kept.matrix.size() == 0;
  }

  virtual int num_factorizations() const = 0;

  // Advances `state` by the iterate, except its time.
  virtual void Commit(State& state) = 0;
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_JOINT_SYSTEM_H_
