// What bodies and the joints between them exchange, by SIMD.
//
// A body in lane l of a pack (joint_chain_kernel.h) has its joints at `places`
// of its pack, the same number in all lanes. Where a body has fewer, weights
// g₀, g₁, g₂, g₃ are zero, and the joint is one whose impulse is always zero.
// Joints are in packs of eight, too. Lanes never mix, products are rounded
// before they are added: the bits are the same with every instruction set.
//
// Arrays of blocks, and of where joints and points are, are aligned for vectors
// (AllocatePacks); arrays of three numbers a joint need not be.

#ifndef EMMY_INTEGRATE_JOINT_POINTS_H_
#define EMMY_INTEGRATE_JOINT_POINTS_H_

#include <cstddef>
#include <cstdint>

namespace emmy {

// Offsets in blocks of eight numbers.
struct PlaceBlock {
  static constexpr int kWeight = 0;
  static constexpr int kSize = 4;
};
// Σ gₐ aₐ and Σ gₐ bₐ of two sets of vectors of a body.
struct PointBlock {
  static constexpr int kFirst = 0;
  static constexpr int kSecond = 3;
  static constexpr int kSize = 6;
};
// The rate of the gap of a joint at the start of a step.
struct JointRateBlock {
  static constexpr int kRate = 0;  // G w₀, by values
  static constexpr int kRest = 3;  // and by compensations.
  static constexpr int kSize = 6;
};
inline constexpr int kJointFrameSize = 9;  // By columns.

// One pack: the sums of `first` and `second`, twelve blocks each, at every
// place.
void SumAtPlaces(const double* weights, int places, const double* first,
                 const double* second, double* points);

// One pack: twelve blocks Σ gₐ p over its places, times `factor`; p are the
// vectors that begin at `impulses[joint]`. Added to what is in `loads` or, if
// `is_first`, in place of it.
void AddImpulses(const double* weights, const int64_t* joint, int places,
                 double factor, const double* impulses, bool is_first,
                 double* loads);

// Packs of joints. A joint's two points are where point[0] and point[1] say in
// the PointBlocks, in numbers.
struct JointPacks {
  int count = 0;  // Joints; numbers of the last pack beyond are unused.
  const int64_t* point[2] = {nullptr, nullptr};
  const double* points = nullptr;
};

// G w₀ of the sums of w₀ and its compensations.
void SetJointRates(const JointPacks& joints, double* rates);
// Qᵀ (G u − 2 G w̄), three numbers a joint, of the sums of u and Δw.
void SetRightSide(const JointPacks& joints, const double* rates,
                  const double* frames, double* right_side);
// step = Q x, impulses less that; x three numbers a joint, as the others.
void TurnBack(int count, const double* frames, const double* x, double* step,
              double* impulses);

}  // namespace emmy

#endif  // EMMY_INTEGRATE_JOINT_POINTS_H_
