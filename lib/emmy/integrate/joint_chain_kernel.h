// Sweeps along a chain of ANCF bodies, eight pieces of it at a time, by SIMD.
//
// A chain is cut into pieces of `length` bodies, eight pieces make a group, and
// lane l of pack t of a group is body t of its piece l. Everything a body has
// is in blocks of eight numbers, one a lane. A body has a joint on its right
// and one on its left, which is the right one of the body before; the last
// right joint of a piece is its separator. Lanes never mix in a sweep, so the
// bits are the same with every instruction set.
//
// One iteration on (EM-9), with the bodies eliminated (EM-14):
//   forward   residual r and u = K⁻¹ r of each body, joints eliminated from the
//             piece's start to its end (block tridiagonal S)      (EM-16)
//             K⁻¹ with the turn and strain of the step in a row   (EM-17)
//   between   the separators, by the caller
//   backward  joint impulses and velocity increments
//
// Without a factor there is no row: forward and backward treat each body by
// itself, and the caller the joints between them (joint_net.h).
//
// Weights g₀, g₁, g₂, g₃ of a joint on a body are those of x̄, e₁, e₂, e₃; zero
// where there is no joint. Principal second moments only.

#ifndef EMMY_INTEGRATE_JOINT_CHAIN_KERNEL_H_
#define EMMY_INTEGRATE_JOINT_CHAIN_KERNEL_H_

#include <cstddef>

namespace emmy {

inline constexpr int kPackLanes = 8;

// Offsets in blocks of eight numbers. Matrices by columns, symmetric ones as
// 00, 10, 11, 20, 21, 22.
struct BodyConstants {
  static constexpr int kMass = 0;
  static constexpr int kInverseMass = 1;
  static constexpr int kMoment = 2;        // Mⁱⁱ
  static constexpr int kStiffness = 5;     // b
  static constexpr int kInverse = 11;      // As in (EM-6).
  static constexpr int kShear = 17;        // c of the shear pairs.
  static constexpr int kBodySize = 20;     // That is all without a row.
  static constexpr int kRightWeight = 20;  // g of the right joint.
  static constexpr int kLeftWeight = 24;   // Of the left one.
  // Ŝ of the right joint, symmetric, and B, which makes of a turn φ the axial
  // vector of what it adds.
  static constexpr int kRightCompliance = 28;
  static constexpr int kRightTurn = 34;
  static constexpr int kLeftCompliance = 43;  // Of the left one.
  static constexpr int kLeftTurn = 49;
  // Right row, left column; and what turns about the three axes add to it.
  static constexpr int kCrossCompliance = 58;
  static constexpr int kCrossTurn = 67;
  // And what each of the six strains does.
  static constexpr int kRightStrain = 94;
  static constexpr int kLeftStrain = 130;
  static constexpr int kCrossStrain = 166;
  static constexpr int kSize = 220;
};

// The start of the step.
struct BodyStartBlock {
  static constexpr int kPosition = 0;  // q₀
  static constexpr int kGradientCompensation = 12;
  static constexpr int kVelocity = 21;  // w₀
  static constexpr int kVelocityCompensation = 33;
  static constexpr int kStrain = 45;
  static constexpr int kStrainCompensation = 51;
  static constexpr int kSize = 57;
};

// What the iteration changes.
struct BodyIterateBlock {
  static constexpr int kRateIncrement = 0;  // Δw
  static constexpr int kImpulse = 12;       // Δt λ of the right joint.
  static constexpr int kSize = 15;
};

// From the forward sweep to the backward one; then the solution.
struct BodyScratchBlock {
  static constexpr int kCorrection = 0;         // u
  static constexpr int kJoint = 12;             // B⁻¹ y of the right joint.
  static constexpr int kPositionIncrement = 0;  // Δq, by Finish.
  static constexpr int kStrainIncrement = 12;   // Δε, by Finish.
  static constexpr int kSize = 18;
};

// Where the equations of a correction are taken, and the elimination, are kept
// in single precision: a long chain is as fast as memory streams, and the next
// residual corrects what rounding leaves. Chains of 60 to 5000 hanging boxes
// need the iterations they needed in double precision. Where numbers go beyond
// 3e38 the iteration does not converge, which JointStep knows how to treat.
struct BodyFrameBlock {
  static constexpr int kFrame = 0;    // Q
  static constexpr int kTurn = 9;     // φ, in the frame; with a row only.
  static constexpr int kStrain = 12;  // ε̄, likewise.
  static constexpr int kSize = 18;
};

// Of the elimination of the right joint, with its block B of the diagonal when
// it is its turn.
struct JointFactorBlock {
  static constexpr int kInverse = 0;   // B⁻¹
  static constexpr int kBelow = 9;     // Row of the next joint, this column.
  static constexpr int kAtStart = 18;  // Row of the left end, this column.
  static constexpr int kNext = 27;     // B⁻¹ times what is right of B.
  static constexpr int kStart = 36;  // B⁻¹ C, C the column of the left end.
  static constexpr int kSize = 45;
};

// Of the pieces as a whole.
struct PieceBlock {
  // Given by the caller:
  static constexpr int kLeftImpulse = 0;  // Δt λ of the joint at the left end.
  static constexpr int kRightStep = 3;    // Correction of the separator, and
  static constexpr int kLeftStep = 6;     // of the one of the piece before.
  // Written by Forward: the piece's part of the separator's right side (its
  // residual and twice its rate, by values and by small parts), likewise for
  // the separator of the piece before; then of the matrix.
  static constexpr int kRightSide = 9;
  static constexpr int kRightRate = 12;
  static constexpr int kRightRest = 15;
  static constexpr int kLeftSide = 18;
  static constexpr int kLeftRate = 21;
  static constexpr int kLeftRest = 24;
  static constexpr int kRightMatrix = 27;
  static constexpr int kLeftMatrix = 36;
  static constexpr int kBelow = 45;  // Right row, left column.
  static constexpr int kAbove = 54;  // Left row, right column.
  // Sums over the piece.
  static constexpr int kForce = 63;
  static constexpr int kMoment = 66;
  static constexpr int kWork = 69;
  static constexpr int kForceSize = 70;   // Squares of the terms' sizes,
  static constexpr int kMomentSize = 71;  // with arm,
  static constexpr int kWorkSize = 72;    // with rate.
  static constexpr int kRate = 73;        // Largest |w₀|, |w̄|.
  static constexpr int kEnergy = 74;      // Of the start.
  static constexpr int kWeightWork = 75;  // In absolute value.
  static constexpr int kLoadWork = 76;    // Of the loads, signed: the joints'
                                          // share of them cancels.
  // Written by Backward.
  static constexpr int kCorrection = 77;     // Largest |δw|.
  static constexpr int kCorrectionSum = 78;  // Not finite if one is not.
  static constexpr int kSize = 79;
};

// Of one group: arrays of `length` packs.
struct ChainGroup {
  int length = 0;
  double time_step = 0.0;
  double shift = 0.0;                        // κ
  double gravity[3] = {0, 0, 0};             // g [m/s²]
  const double* const* constants = nullptr;  // A block a pack.
  const double* start = nullptr;
  // Δt F, 12 a body, or none; without a factor less Gᵀ (Δt λ), and in the
  // backward sweep Gᵀ δ(Δt λ).
  const double* loads = nullptr;
  double* iterate = nullptr;
  double* scratch = nullptr;
  float* frames = nullptr;
  float* factor = nullptr;  // Of a row.
  double* piece = nullptr;
};

enum class ForwardWork {
  kFactorize,  // In the first iteration: the factor and all sums too.
  kSizes,      // The sizes of rounding too.
  kResidual,   // Residual, elimination, force, moment and work.
};

void ChainForward(const ChainGroup& group, ForwardWork work);
void ChainBackward(const ChainGroup& group);
// Δq and Δε of Δw.
void ChainFinish(const ChainGroup& group);

// Where a body of a pack is in the state.
struct BodyPlace {
  double* value[3] = {nullptr, nullptr, nullptr};  // q, w and ε,
  double* compensation[3] = {nullptr, nullptr, nullptr};
  // And the accelerations' (EXTRA-1), an order `order_stride` after the other.
  double* differences = nullptr;
  std::ptrdiff_t order_stride = 0;
  double* next = nullptr;
};

// (EM-4) after ChainFinish, for one body, lane `lane` of a pack; and the
// prediction of its accelerations by order `order`. `errors`, kErrorLanes for
// each of four orders, grow to what they would have missed them by.
inline constexpr int kErrorLanes = 4;
void CommitBody(const double* scratch, const double* iterate, int lane,
                double time_step, int order, const BodyPlace& place,
                double* errors);

}  // namespace emmy

#endif  // EMMY_INTEGRATE_JOINT_CHAIN_KERNEL_H_
