// The ANCF bodies of a structure in packs of eight, for SIMD.
//
// Lane l of pack p is slot 8 p + l; each number a body has is one of a block of
// eight, see joint_chain_kernel.h. Slots without a body hold one at rest and
// without mass, which adds nothing to anything.

#ifndef EMMY_INTEGRATE_BODY_PACKS_H_
#define EMMY_INTEGRATE_BODY_PACKS_H_

#include <algorithm>
#include <cstddef>
#include <vector>

#include "emmy/base/types.h"
#include "emmy/integrate/joint_chain_kernel.h"
#include "emmy/integrate/structure.h"
#include "emmy/model/state.h"
#include "emmy/numerics/extrapolation.h"
#include "hwy/aligned_allocator.h"

namespace emmy {

inline constexpr size_t kLanes = kPackLanes;

template <typename Number>
using PackArrayOf = hwy::AlignedFreeUniquePtr<Number[]>;
using PackArray = PackArrayOf<double>;

// Zeros.
template <typename Number = double>
PackArrayOf<Number> AllocatePacks(size_t packs, int blocks) {
  const size_t size =
      std::max<size_t>(packs, 1) * static_cast<size_t>(blocks) * kLanes;
  PackArrayOf<Number> array = hwy::AllocateAligned<Number>(size);
  std::fill_n(array.get(), size, Number(0));
  return array;
}

// Entries, vectors and matrices of one lane of a pack.
template <typename Number>
Number& PackEntry(Number* pack, int block, size_t lane) {
  return pack[static_cast<size_t>(block) * kLanes + lane];
}
inline Vector3d PackVector(const double* pack, int block, size_t lane) {
  return {PackEntry(pack, block, lane), PackEntry(pack, block + 1, lane),
          PackEntry(pack, block + 2, lane)};
}
inline void SetPackVector(const Vector3d& v, double* pack, int block,
                          size_t lane) {
  for (int i = 0; i < 3; ++i) PackEntry(pack, block + i, lane) = v(i);
}
Matrix3d PackMatrix(const double* pack, int block, size_t lane);
Matrix3d PackMatrix(const float* pack, int block, size_t lane);
void SetPackMatrix(const Matrix3d& m, double* pack, int block, size_t lane);
void SetPackSymmetric(const Matrix3d& m, double* pack, int block, size_t lane);

class BodyPacks {
 public:
  // Body i of `structure`, which must outlive this, is in slot `slots[i]`.
  BodyPacks(const Structure& structure, double time_step, size_t packs,
            std::vector<size_t> slots);

  size_t packs() const { return packs_; }
  const std::vector<size_t>& slots() const { return slots_; }

  // The arrays from pack `pack` on.
  double* start(size_t pack) { return Of(start_, pack, BodyStartBlock::kSize); }
  double* iterate(size_t pack) {
    return Of(iterate_, pack, BodyIterateBlock::kSize);
  }
  double* scratch(size_t pack) {
    return Of(scratch_, pack, BodyScratchBlock::kSize);
  }
  float* frames(size_t pack) {
    return Of(frames_, pack, BodyFrameBlock::kSize);
  }
  // Null if there is no load.
  double* loads(size_t pack) {
    return loads_ ? Of(loads_, pack, kNumLoads) : nullptr;
  }
  static constexpr int kNumLoads = 12;

  // Makes room for impulses besides those of the structure's loads; zero.
  void NeedLoads();

  // The start and the start value of Δw of the packs [first, last).
  void Load(const State& state, size_t first, size_t last);

  // Δt F of all loads at the iterate in place of what is in loads(); false, and
  // nothing done, if there are none.
  bool SetLoads();

  // After ChainFinish: advances the packs [first, last) and predicts their
  // accelerations by order `order`.
  void Commit(size_t first, size_t last, int order, State& state,
              Extrapolation::Errors* errors);
  void Predict(size_t first, size_t last, int order, State& state) const;
  void AddLoadWork(State& state);

 private:
  struct Place {
    Eigen::Index position = -1;  // None for a slot without a body.
    Eigen::Index velocity = 0;
    Eigen::Index strain = 0;
  };
  template <typename Number>
  static Number* Of(const PackArrayOf<Number>& array, size_t pack, int blocks) {
    return array.get() + pack * static_cast<size_t>(blocks) * kLanes;
  }
  Matrix3d Increment(size_t slot);
  Matrix3d Duals(size_t slot, const Matrix3d& increment);

  const Structure* structure_;
  double time_step_;
  size_t packs_;
  std::vector<size_t> slots_;
  std::vector<Place> places_;
  PackArray start_, iterate_, scratch_, loads_;
  PackArrayOf<float> frames_;
  Matrix3Xd constant_loads_;  // Δt F, a column a vector; none: no loads.
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_BODY_PACKS_H_
