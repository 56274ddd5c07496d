// ANCF bodies joined at shared points in any way: trees, loops, grids.
//
// The correction is that of (EM-14). The matrix S + κ of the joints, one 3×3
// block for each pair of joints on a body, is sparse; written in frames that
// turn with the bodies it changes only with their relative rotation, so that a
// factorisation serves many steps (EM-11).

#ifndef EMMY_INTEGRATE_JOINT_NET_H_
#define EMMY_INTEGRATE_JOINT_NET_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "emmy/base/types.h"
#include "emmy/integrate/body_packs.h"
#include "emmy/integrate/coupled_tangent.h"
#include "emmy/integrate/joint_graph.h"
#include "emmy/integrate/joint_points.h"
#include "emmy/integrate/joint_system.h"
#include "emmy/integrate/structure.h"
#include "emmy/model/state.h"
#include "emmy/numerics/symmetric_block_matrix.h"
#include "emmy/numerics/symmetric_factor.h"

namespace emmy {

class JointNet : public JointSystem {
 public:
  // `structure` must outlive the net.
  JointNet(const Structure& structure, const std::vector<BodyJoint>& joints,
           double time_step);

  void Load(const State& state) override;
  const JointSums& Evaluate(ForwardWork work) override;
  JointCorrection Correct(std::optional<ForwardWork> next) override;
  void Commit(State& state) override;
  bool Renew() override;
  void Forget() override { renew_ = true; }
  KeptTangent Keep() const override;
  bool Restore(const KeptTangent& kept) override;
  int num_factorizations() const override { return num_factorizations_; }

 private:
  // A body's part of S: joints `row` ≥ `column`.
  struct Coupling {
    int row;
    int column;
    size_t slot;
    Matrix3d compliance;  // Ŝ
    SymmetricBlockMatrix::Slot place;
  };

  static SymmetricBlockMatrix MakeMatrix(const std::vector<BodyJoint>& joints);
  void MakeCouplings(const Structure& structure,
                     const std::vector<BodyJoint>& joints);
  void MakePlaces(const std::vector<BodyJoint>& joints);
  int NumPlaces(size_t pack) const;
  ChainGroup Group(size_t group);
  JointPacks Joints() const;
  // The sums of what vectors(pack) says at all places.
  template <typename Vectors>
  void SumPoints(const Vectors& vectors) {
    for (size_t pack = 0; pack < packs_.packs(); ++pack) {
      const auto [first, second] = vectors(pack);
      const size_t place = first_place_[pack];
      SumAtPlaces(weights_.get() + place * PlaceBlock::kSize * kLanes,
                  NumPlaces(pack), first, second,
                  points_.get() + place * PointBlock::kSize * kLanes);
    }
  }
  void SetImpulses(size_t group, double factor, const VectorXd& impulses,
                   bool is_first);
  void SetFrames();
  Matrix3d Frame(int joint) const;
  bool Factorize();

  const Structure* structure_;
  double time_step_;
  double shift_;
  BodyPacks packs_;
  int num_joints_;
  std::vector<Eigen::Index> multipliers_;
  std::vector<size_t> first_bodies_;  // Slots.
  // Of each pack of bodies, and one more; see joint_points.h.
  std::vector<size_t> first_place_;
  PackArray weights_, points_;
  PackArrayOf<int64_t> joint_of_place_;
  std::array<PackArrayOf<int64_t>, 2> point_of_joint_;
  PackArray rates_, frames_;
  // Δt λ and its correction, three numbers a joint; the last three are zero,
  // for places of bodies that have fewer joints than others.
  VectorXd impulses_, steps_;
  std::vector<Coupling> couplings_;
  SymmetricBlockMatrix matrix_;
  SymmetricFactor factor_;
  bool renew_ = true;
  bool frames_are_old_ = true;  // Of an earlier step.
  bool is_fresh_ = false;       // Made in this step.
  bool is_singular_ = false;
  PackArray constants_, pieces_;
  std::vector<const double*> constants_of_pack_;
  VectorXd right_side_, solution_;
  JointSums sums_;
  int rate_order_ = 0;  // Of the last step's prediction.
  int num_factorizations_ = 0;
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_JOINT_NET_H_
