// The symmetric tangent (EM-10) of a structure and its kept factorisation.
//
//   K = M + ¼ Δt² [t⁺ φφᵀ ⊗ 1 + 2 t' φφᵀ ⊗ d̄ d̄ᵀ]   (lines)
//         + ¼ Δt² Σ bₖ gₖ gₖᵀ                        (ANCF bodies)
//   A = [K, Gᵀ; G, −κ]
// Every vector coordinate has a frame that follows the motion: the vectors of
// an ANCF body that body's own, where its penalty terms are the constants of
// (EM-6); nodes that of the structure as a whole. Written in these frames A
// changes only with relative rotation and deformation, so that a factorisation
// serves many steps.                                               (EM-11)

#ifndef EMMY_INTEGRATE_COUPLED_TANGENT_H_
#define EMMY_INTEGRATE_COUPLED_TANGENT_H_

#include <array>
#include <cstdint>
#include <vector>

#include "emmy/base/types.h"
#include "emmy/integrate/structure.h"
#include "emmy/numerics/symmetric_block_matrix.h"
#include "emmy/numerics/symmetric_factor.h"

namespace emmy {

// What the tangent depends on.
struct TangentPoint {
  const Matrix3Xd& mean_positions;  // q̄, one column a vector.
  const Matrix3Xd& line_mean;       // d̄, one column a line.
  const VectorXd& line_tension;     // t
  const VectorXd& line_derivative;  // t'
};

// What later steps need of a factorisation: a run that is taken up again
// repeats every bit only with the same factors.
struct KeptTangent {
  VectorXd matrix;      // Entries of A when it was factorised; none: not kept.
  Matrix3Xd positions;  // q̄ at that point.
  Matrix3d turn = Matrix3d::Identity();  // Of the whole since then.
  // By JointStep: the fewest iterations of a step with it.
  int64_t fewest_iterations = 0;
  // How many more than that the others have needed.
  int64_t excess_iterations = 0;
};

class CoupledTangent {
 public:
  // `structure` must outlive the tangent.
  CoupledTangent(const Structure& structure, double time_step,
                 SymmetricFactor::Method method);

  // Assembles and factorises at `point`. False if the factorisation fails.
  bool Factorize(const TangentPoint& point);

  // The factorisation as it is now.
  KeptTangent Keep() const;
  // Back to one of a tangent of the same structure and step. False, and nothing
  // is factorised, if the sizes do not fit or the matrix cannot be factorised.
  bool Restore(const KeptTangent& kept);

  // Frames of the nodes: how the whole has turned since the factorisation.
  void FollowStructure(const Matrix3Xd& mean_positions);

  // Frames of the bodies, from q̄ and q₁.
  void FollowBodies(const Matrix3Xd& mean_positions,
                    const Matrix3Xd& end_positions);

  // Solves (EM-10): columns of vectors, then of constraints.
  void Solve(const Matrix3Xd& residual, const Matrix3Xd& constraint_residual,
             Matrix3Xd* correction, Matrix3Xd* multiplier_correction,
             WorkTeam* team = nullptr);

  // By Factorize and Restore so far.
  int num_factorizations() const { return num_factorizations_; }
  // In use: never kAutomatic.
  SymmetricFactor::Method method() const { return factor_.method(); }

 private:
  static SymmetricBlockMatrix MakeMatrix(const Structure& structure);
  void FindSlots();
  void Assemble(const TangentPoint& point);
  // Of the frame of vector `v`.
  const Matrix3d& Rotation(int v) const {
    const int body = body_of_[static_cast<size_t>(v)];
    return body < 0 ? turn_ : frames_[static_cast<size_t>(body)].rotation;
  }
  void AddBodies();
  void AddLines(const TangentPoint& point);

  const Structure* structure_;
  double time_step_;
  double shift_ = 0.0;  // κ [1/kg]
  SymmetricBlockMatrix matrix_;
  SymmetricFactor factor_;
  std::vector<SymmetricBlockMatrix::Slot> mass_slots_;
  std::vector<std::array<SymmetricBlockMatrix::Slot, 6>> body_slots_;
  std::vector<SymmetricBlockMatrix::Slot> line_slots_;
  std::vector<SymmetricBlockMatrix::Slot> constraint_slots_;
  struct OwnMass {
    int vector;
    double mass;  // On the diagonal.
    bool translates;
  };
  std::vector<OwnMass> own_masses_;
  Matrix3Xd positions_;  // q̄ at the factorisation.
  // Frames of the nodes: the turn of the whole since then.
  Matrix3d turn_ = Matrix3d::Identity();
  // Those of a body's vectors, and for its gradient vectors Ē⁻¹ and E₁⁻ᵀ,
  // with which the penalty terms are those of the Jacobian.
  struct BodyFrame {
    Matrix3d rotation = Matrix3d::Identity();
    Matrix3d left = Matrix3d::Identity();
    Matrix3d right = Matrix3d::Identity();
  };
  std::vector<BodyFrame> frames_;
  std::vector<int> body_of_;  // Of each vector; −1: a node.
  VectorXd right_side_, solution_;
  int num_factorizations_ = 0;
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_COUPLED_TANGENT_H_
