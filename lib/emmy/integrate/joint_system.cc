#include "emmy/integrate/joint_system.h"

#include <algorithm>
#include <cmath>

#include "emmy/integrate/body_packs.h"

namespace emmy {
namespace {

const double* Piece(const double* pieces, size_t piece) {
  return pieces + piece / kLanes * PieceBlock::kSize * kLanes;
}

double Sum(const double* pieces, size_t groups, int block) {
  double sum = 0.0;
  for (size_t i = 0; i < groups * kLanes; ++i) {
    sum += PackEntry(Piece(pieces, i), block, i % kLanes);
  }
  return sum;
}

Vector3d VectorSum(const double* pieces, size_t groups, int block) {
  return {Sum(pieces, groups, block), Sum(pieces, groups, block + 1),
          Sum(pieces, groups, block + 2)};
}

double Largest(const double* pieces, size_t groups, int block) {
  double largest = 0.0;
  for (size_t i = 0; i < groups * kLanes; ++i) {
    largest = std::max(largest, PackEntry(Piece(pieces, i), block, i % kLanes));
  }
  return largest;
}

}  // namespace

void AddPieceSums(ForwardWork work, const double* pieces, size_t groups,
                  JointSums* sums) {
  using P = PieceBlock;
  sums->force = VectorSum(pieces, groups, P::kForce);
  sums->moment = VectorSum(pieces, groups, P::kMoment);
  sums->work = Sum(pieces, groups, P::kWork);
  if (work == ForwardWork::kResidual) return;
  sums->force_size = Sum(pieces, groups, P::kForceSize);
  sums->moment_size = Sum(pieces, groups, P::kMomentSize);
  sums->work_size = Sum(pieces, groups, P::kWorkSize);
  sums->rate = Largest(pieces, groups, P::kRate);
  sums->load_work = Sum(pieces, groups, P::kWeightWork) +
                    std::abs(Sum(pieces, groups, P::kLoadWork));
  if (work != ForwardWork::kFactorize) return;
  sums->energy = Sum(pieces, groups, P::kEnergy);
}

JointCorrection PieceCorrection(const double* pieces, size_t groups) {
  JointCorrection correction;
  correction.largest = Largest(pieces, groups, PieceBlock::kCorrection);
  correction.is_finite =
      std::isfinite(Sum(pieces, groups, PieceBlock::kCorrectionSum)) &&
      std::isfinite(correction.largest);
  return correction;
}

}  // namespace emmy
