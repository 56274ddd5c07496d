// Compiled once for each instruction set: Highway includes this file again
// from foreach_target.h.

#include "emmy/integrate/joint_points.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "emmy/integrate/joint_chain_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "emmy/integrate/joint_points.cc"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
//
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace emmy {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, kPackLanes>;
using V = hn::Vec<Tag>;
using IndexTag = hn::RebindToSigned<Tag>;
constexpr int kStep = static_cast<int>(hn::MaxLanes(Tag()));

HWY_INLINE V Get(const double* p, int block) {
  return hn::Load(Tag(), p + block * kPackLanes);
}
HWY_INLINE void Put(V x, double* p, int block) {
  hn::Store(x, Tag(), p + block * kPackLanes);
}

HWY_INLINE void WeightedSum(const V* weight, const double* vectors,
                            double* sum) {
  for (int i = 0; i < 3; ++i) {
    V s = weight[0] * Get(vectors, i);
    for (int a = 1; a < 4; ++a) s = s + weight[a] * Get(vectors, 3 * a + i);
    Put(s, sum, i);
  }
}

void SumPlaces(const double* weights, int places, const double* first,
               const double* second, double* points) {
  for (int place = 0; place < places; ++place) {
    for (int lane = 0; lane < kPackLanes; lane += kStep) {
      V weight[4];
      for (int a = 0; a < 4; ++a) weight[a] = Get(weights + lane, a);
      double* const to = points + lane;
      WeightedSum(weight, first + lane, to + PointBlock::kFirst * kPackLanes);
      WeightedSum(weight, second + lane, to + PointBlock::kSecond * kPackLanes);
    }
    weights += PlaceBlock::kSize * kPackLanes;
    points += PointBlock::kSize * kPackLanes;
  }
}

void Impulses(const double* weights, const int64_t* joint, int places,
              double factor, const double* impulses, bool is_first,
              double* loads) {
  const Tag tag;
  for (int lane = 0; lane < kPackLanes; lane += kStep) {
    V load[12];
    for (int k = 0; k < 12; ++k) {
      load[k] = is_first ? hn::Zero(tag) : Get(loads + lane, k);
    }
    for (int place = 0; place < places; ++place) {
      const auto index =
          hn::Load(IndexTag(), joint + place * kPackLanes + lane);
      const double* const weight =
          weights +
          static_cast<ptrdiff_t>(place) * PlaceBlock::kSize * kPackLanes + lane;
      V impulse[3];
      for (int i = 0; i < 3; ++i) {
        impulse[i] =
            hn::Set(tag, factor) * hn::GatherIndex(tag, impulses + i, index);
      }
      for (int a = 0; a < 4; ++a) {
        const V g = Get(weight, a);
        for (int i = 0; i < 3; ++i) {
          load[3 * a + i] = load[3 * a + i] + g * impulse[i];
        }
      }
    }
    for (int k = 0; k < 12; ++k) Put(load[k], loads + lane, k);
  }
}

// The sum of a joint's two points.
HWY_INLINE V AtBoth(const JointPacks& joints, ptrdiff_t joint, int block) {
  const Tag tag;
  const double* const base = joints.points + block * kPackLanes;
  return hn::GatherIndex(tag, base,
                         hn::Load(IndexTag(), joints.point[0] + joint)) +
         hn::GatherIndex(tag, base,
                         hn::Load(IndexTag(), joints.point[1] + joint));
}

// Calls at(first joint of a vector, its lane, its pack).
template <typename At>
HWY_INLINE void ForPacks(int count, const At& at) {
  for (ptrdiff_t joint = 0; joint < count; joint += kStep) {
    at(joint, joint % kPackLanes, joint / kPackLanes);
  }
}

// Of three numbers a joint as many as there are.
HWY_INLINE void StoreVectors(const V* v, int count, ptrdiff_t joint,
                             double* to) {
  HWY_ALIGN double numbers[size_t{3 * kStep}];
  hn::StoreInterleaved3(v[0], v[1], v[2], Tag(), numbers);
  const ptrdiff_t left = std::min<ptrdiff_t>(kStep, count - joint);
  std::copy_n(numbers, 3 * left, to + 3 * joint);
}
HWY_INLINE void LoadVectors(const double* from, int count, ptrdiff_t joint,
                            V* v) {
  HWY_ALIGN double numbers[size_t{3 * kStep}] = {};
  const ptrdiff_t left = std::min<ptrdiff_t>(kStep, count - joint);
  std::copy_n(from + 3 * joint, 3 * left, numbers);
  hn::LoadInterleaved3(Tag(), numbers, v[0], v[1], v[2]);
}

void Rates(const JointPacks& joints, double* rates) {
  ForPacks(joints.count, [&](ptrdiff_t joint, ptrdiff_t lane, ptrdiff_t pack) {
    double* const to = rates + pack * JointRateBlock::kSize * kPackLanes + lane;
    for (int i = 0; i < 3; ++i) {
      Put(AtBoth(joints, joint, PointBlock::kFirst + i), to,
          JointRateBlock::kRate + i);
      Put(AtBoth(joints, joint, PointBlock::kSecond + i), to,
          JointRateBlock::kRest + i);
    }
  });
}

void RightSide(const JointPacks& joints, const double* rates,
               const double* frames, double* right_side) {
  const V half = hn::Set(Tag(), 0.5);
  const V two = hn::Set(Tag(), 2.0);
  ForPacks(joints.count, [&](ptrdiff_t joint, ptrdiff_t lane, ptrdiff_t pack) {
    const double* const rate =
        rates + pack * JointRateBlock::kSize * kPackLanes + lane;
    const double* const frame =
        frames + pack * kJointFrameSize * kPackLanes + lane;
    V side[3];
    for (int i = 0; i < 3; ++i) {
      // G w̄: its parts cancel, the largest first.
      const V rest = Get(rate, JointRateBlock::kRest + i) +
                     half * AtBoth(joints, joint, PointBlock::kSecond + i);
      side[i] = AtBoth(joints, joint, PointBlock::kFirst + i) -
                two * (Get(rate, JointRateBlock::kRate + i) + rest);
    }
    V turned[3];
    for (int c = 0; c < 3; ++c) {
      turned[c] = Get(frame, 3 * c) * side[0] +
                  Get(frame, 3 * c + 1) * side[1] +
                  Get(frame, 3 * c + 2) * side[2];
    }
    StoreVectors(turned, joints.count, joint, right_side);
  });
}

void Back(int count, const double* frames, const double* x, double* step,
          double* impulses) {
  ForPacks(count, [&](ptrdiff_t joint, ptrdiff_t lane, ptrdiff_t pack) {
    const double* const frame =
        frames + pack * kJointFrameSize * kPackLanes + lane;
    V along[3];
    V impulse[3];
    LoadVectors(x, count, joint, along);
    LoadVectors(impulses, count, joint, impulse);
    V turned[3];
    for (int i = 0; i < 3; ++i) {
      turned[i] = Get(frame, i) * along[0] + Get(frame, 3 + i) * along[1] +
                  Get(frame, 6 + i) * along[2];
      impulse[i] = impulse[i] - turned[i];
    }
    StoreVectors(turned, count, joint, step);
    StoreVectors(impulse, count, joint, impulses);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace emmy
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace emmy {

HWY_EXPORT(SumPlaces);
HWY_EXPORT(Impulses);
HWY_EXPORT(Rates);
HWY_EXPORT(RightSide);
HWY_EXPORT(Back);

void SumAtPlaces(const double* weights, int places, const double* first,
                 const double* second, double* points) {
  HWY_DYNAMIC_DISPATCH(SumPlaces)(weights, places, first, second, points);
}

void AddImpulses(const double* weights, const int64_t* joint, int places,
                 double factor, const double* impulses, bool is_first,
                 double* loads) {
  HWY_DYNAMIC_DISPATCH(Impulses)
  (weights, joint, places, factor, impulses, is_first, loads);
}

void SetJointRates(const JointPacks& joints, double* rates) {
  HWY_DYNAMIC_DISPATCH(Rates)(joints, rates);
}

void SetRightSide(const JointPacks& joints, const double* rates,
                  const double* frames, double* right_side) {
  HWY_DYNAMIC_DISPATCH(RightSide)(joints, rates, frames, right_side);
}

void TurnBack(int count, const double* frames, const double* x, double* step,
              double* impulses) {
  HWY_DYNAMIC_DISPATCH(Back)(count, frames, x, step, impulses);
}

}  // namespace emmy
#endif  // HWY_ONCE
