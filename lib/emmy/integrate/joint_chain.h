// A row of ANCF bodies, each joined to the next by a shared point.
//
// Correction of (EM-9) with the bodies eliminated, K + P of (EM-17) for K:
//   (S + κ) δ(Δt λ) = G K⁻¹ r − 2 G w̄,  S = G K⁻¹ Gᵀ
//   δw = K⁻¹ r − K⁻¹ Gᵀ δ(Δt λ)                                     (EM-14)
// S has 3×3 blocks, is block tridiagonal and, by the turn of the step, not
// symmetric. It is factorised in the first iteration of each step.
//
// The row is cut into pieces, eight of which are eliminated side by side
// (joint_chain_kernel.h); the joints between pieces come last.      (EM-16)
// The cuts depend on the number of bodies alone.

#ifndef EMMY_INTEGRATE_JOINT_CHAIN_H_
#define EMMY_INTEGRATE_JOINT_CHAIN_H_

#include <memory>
#include <optional>
#include <vector>

#include "emmy/base/types.h"
#include "emmy/base/work_team.h"
#include "emmy/integrate/body_packs.h"
#include "emmy/integrate/joint_chain_kernel.h"
#include "emmy/integrate/joint_graph.h"
#include "emmy/integrate/joint_system.h"
#include "emmy/integrate/structure.h"
#include "emmy/model/state.h"

namespace emmy {

class JointChain : public JointSystem {
 public:
  // `structure` must outlive the chain.
  JointChain(const Structure& structure, const std::vector<BodyJoint>& joints,
             const BodyRow& row, double time_step, int num_threads);

  void Load(const State& state) override;
  const JointSums& Evaluate(ForwardWork work) override;
  JointCorrection Correct(std::optional<ForwardWork> next) override;
  void Commit(State& state) override;
  int num_factorizations() const override { return num_factorizations_; }

 private:
  // A joint between pieces: its part of the factors L U, and its solution.
  struct Separator {
    Matrix3d inverse = Matrix3d::Zero();  // Of U's block.
    Matrix3d below = Matrix3d::Zero();    // L's, column of the one before.
    Matrix3d above = Matrix3d::Zero();    // U's, row of the one before.
    Vector3d step = Vector3d::Zero();
  };

  // What commits of one thread find, apart from those of others.
  struct alignas(128) Errors {
    Extrapolation::Errors rate;
    Extrapolation::Errors multiplier;
  };

  size_t Slot(size_t i) const;
  void MakeConstants(const std::vector<BodyJoint>& joints, const BodyRow& row);
  ChainGroup Group(size_t group);
  void LoadGroup(const State& state, size_t group);
  void CommitGroup(size_t group, State& state, Errors* errors);
  void PredictJoints(size_t group, State& state) const;
  double* Piece(size_t piece);
  void FactorizeSeparators();
  void SolveSeparators();

  const Structure* structure_;
  double time_step_;
  double shift_;
  size_t groups_;
  size_t length_;  // Packs a group.
  std::unique_ptr<BodyPacks> packs_;
  // In the state, of the right joint by slot; −1: none.
  std::vector<Eigen::Index> multipliers_;
  PackArray constants_;
  PackArrayOf<float> factor_;
  PackArray pieces_;
  std::vector<const double*> constants_of_pack_;
  std::vector<Separator> separators_;
  WorkTeam team_;
  JointSums sums_;
  const State* state_ = nullptr;  // To be loaded by the next Evaluate.
  bool is_evaluated_ = false;     // By Correct.
  std::vector<Errors> errors_;    // A thread each.
  // Of the last step's predictions, and likely those of the next.
  int rate_order_ = 0;
  int multiplier_order_ = 0;
  int num_factorizations_ = 0;
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_JOINT_CHAIN_H_
