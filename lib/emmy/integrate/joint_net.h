// ANCF bodies joined at shared points in any way: trees, loops, grids.
//
// The correction is that of (EM-14). The matrix S + κ of the joints, one 3×3
// block for each pair of joints on a body, is sparse; written in frames that
// turn with the bodies it changes only with their relative rotation, so that a
// factorisation serves many steps (EM-11).

#ifndef EMMY_INTEGRATE_JOINT_NET_H_
#define EMMY_INTEGRATE_JOINT_NET_H_

#include <array>
#include <optional>
#include <vector>

#include "emmy/base/types.h"
#include "emmy/integrate/body_packs.h"
#include "emmy/integrate/coupled_tangent.h"
#include "emmy/integrate/joint_graph.h"
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
  KeptTangent Keep() const override;
  bool Restore(const KeptTangent& kept) override;
  int num_factorizations() const override { return num_factorizations_; }

 private:
  struct Joint {
    std::array<size_t, 2> slots = {0, 0};
    std::array<Vector4d, 2> weights;
    int num_bodies = 0;
    Eigen::Index multiplier = 0;
    Vector3d impulse = Vector3d::Zero();  // Δt λ
    Vector3d step = Vector3d::Zero();     // Its correction.
    Vector3d rate = Vector3d::Zero();     // G w₀, by values
    Vector3d rest = Vector3d::Zero();     // and by compensations.
  };
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
  ChainGroup Group(size_t group);
  Matrix3d Frame(const Joint& joint);
  void AddToLoads(double factor, bool steps);
  bool Factorize();

  const Structure* structure_;
  double time_step_;
  double shift_;
  BodyPacks packs_;
  std::vector<Joint> joints_;
  std::vector<Coupling> couplings_;
  SymmetricBlockMatrix matrix_;
  SymmetricFactor factor_;
  bool renew_ = true;
  bool is_fresh_ = false;  // Made in this step.
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
