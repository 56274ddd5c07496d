// Compiled once for each instruction set: Highway includes this file again
// from foreach_target.h.

#include "emmy/integrate/joint_chain_kernel.h"

#include <cstddef>

#include "emmy/base/compensated_sum.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "emmy/integrate/joint_chain_kernel.cc"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
//
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace emmy {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, kPackLanes>;
using V = hn::Vec<Tag>;
constexpr int kStep = static_cast<int>(hn::MaxLanes(Tag()));

struct V3 {
  V v[3];
};
// Symmetric: 00, 10, 11, 20, 21, 22.
struct Symmetric {
  V v[6];
};
struct M3 {
  V3 column[3];
};

HWY_INLINE V Get(const double* p, int k) {
  return hn::Load(Tag(), p + k * kPackLanes);
}
HWY_INLINE void Put(V x, double* p, int k) {
  hn::Store(x, Tag(), p + k * kPackLanes);
}
// Kept in single precision.
using SingleTag = hn::Rebind<float, Tag>;
HWY_INLINE V Get(const float* p, int k) {
  return hn::PromoteTo(Tag(), hn::Load(SingleTag(), p + k * kPackLanes));
}
HWY_INLINE void Put(V x, float* p, int k) {
  hn::Store(hn::DemoteTo(SingleTag(), x), SingleTag(), p + k * kPackLanes);
}
template <typename Number>
HWY_INLINE V3 Get3(const Number* p, int k) {
  return {{Get(p, k), Get(p, k + 1), Get(p, k + 2)}};
}
template <typename Number>
HWY_INLINE void Put3(const V3& x, Number* p, int k) {
  for (int i = 0; i < 3; ++i) Put(x.v[i], p, k + i);
}
HWY_INLINE Symmetric GetSymmetric(const double* p, int k) {
  Symmetric s;
  for (int i = 0; i < 6; ++i) s.v[i] = Get(p, k + i);
  return s;
}
template <typename Number>
HWY_INLINE M3 GetMatrix(const Number* p, int k) {
  return {{Get3(p, k), Get3(p, k + 3), Get3(p, k + 6)}};
}
template <typename Number>
HWY_INLINE void PutMatrix(const M3& m, Number* p, int k) {
  for (int c = 0; c < 3; ++c) Put3(m.column[c], p, k + 3 * c);
}

HWY_INLINE V3 Zero3() {
  const V zero = hn::Zero(Tag());
  return {{zero, zero, zero}};
}
HWY_INLINE V3 Plus(const V3& a, const V3& b) {
  return {{a.v[0] + b.v[0], a.v[1] + b.v[1], a.v[2] + b.v[2]}};
}
HWY_INLINE V3 Minus(const V3& a, const V3& b) {
  return {{a.v[0] - b.v[0], a.v[1] - b.v[1], a.v[2] - b.v[2]}};
}
HWY_INLINE V3 Times(V s, const V3& a) {
  return {{s * a.v[0], s * a.v[1], s * a.v[2]}};
}
HWY_INLINE V Dot(const V3& a, const V3& b) {
  return a.v[0] * b.v[0] + a.v[1] * b.v[1] + a.v[2] * b.v[2];
}
HWY_INLINE V3 Cross(const V3& a, const V3& b) {
  return {{a.v[1] * b.v[2] - a.v[2] * b.v[1], a.v[2] * b.v[0] - a.v[0] * b.v[2],
           a.v[0] * b.v[1] - a.v[1] * b.v[0]}};
}
HWY_INLINE V MaxAbs(const V3& a) {
  return hn::Max(hn::Max(hn::Abs(a.v[0]), hn::Abs(a.v[1])), hn::Abs(a.v[2]));
}
HWY_INLINE V3 Times(const M3& m, const V3& a) {
  return Plus(Plus(Times(a.v[0], m.column[0]), Times(a.v[1], m.column[1])),
              Times(a.v[2], m.column[2]));
}
HWY_INLINE V3 TransposeTimes(const M3& m, const V3& a) {
  return {{Dot(m.column[0], a), Dot(m.column[1], a), Dot(m.column[2], a)}};
}
HWY_INLINE V3 Times(const Symmetric& s, const V3& a) {
  return {{s.v[0] * a.v[0] + s.v[1] * a.v[1] + s.v[3] * a.v[2],
           s.v[1] * a.v[0] + s.v[2] * a.v[1] + s.v[4] * a.v[2],
           s.v[3] * a.v[0] + s.v[4] * a.v[1] + s.v[5] * a.v[2]}};
}
HWY_INLINE M3 Times(const Symmetric& s, const M3& m) {
  return {
      {Times(s, m.column[0]), Times(s, m.column[1]), Times(s, m.column[2])}};
}
// The lower triangle of Aᵀ B, known to be symmetric.
HWY_INLINE Symmetric SymmetricProduct(const M3& a, const M3& b) {
  return {{Dot(a.column[0], b.column[0]), Dot(a.column[1], b.column[0]),
           Dot(a.column[1], b.column[1]), Dot(a.column[2], b.column[0]),
           Dot(a.column[2], b.column[1]), Dot(a.column[2], b.column[2])}};
}
HWY_INLINE M3 Transpose(const M3& m) {
  M3 t;
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) t.column[c].v[r] = m.column[r].v[c];
  }
  return t;
}
// A Bᵀ as A times the columns of Bᵀ.
HWY_INLINE M3 TimesTransposed(const M3& a, const M3& b) {
  const M3 t = Transpose(b);
  return {
      {Times(a, t.column[0]), Times(a, t.column[1]), Times(a, t.column[2])}};
}
// Q S Qᵀ.
HWY_INLINE Symmetric Turned(const M3& q, const Symmetric& s) {
  const M3 t = Transpose(q);
  return SymmetricProduct(t, Times(s, t));
}
HWY_INLINE M3 Plus(const M3& a, const M3& b) {
  return {{Plus(a.column[0], b.column[0]), Plus(a.column[1], b.column[1]),
           Plus(a.column[2], b.column[2])}};
}
HWY_INLINE M3 Minus(const M3& a, const M3& b) {
  return {{Minus(a.column[0], b.column[0]), Minus(a.column[1], b.column[1]),
           Minus(a.column[2], b.column[2])}};
}
HWY_INLINE M3 Times(const M3& a, const M3& b) {
  return {
      {Times(a, b.column[0]), Times(a, b.column[1]), Times(a, b.column[2])}};
}
// Q M Qᵀ.
HWY_INLINE M3 Turned(const M3& q, const M3& m) {
  return TimesTransposed(Times(q, m), q);
}
// s + Hat(a)
HWY_INLINE M3 WithSkew(const Symmetric& s, const V3& a) {
  return {{{{s.v[0], s.v[1] + a.v[2], s.v[3] - a.v[1]}},
           {{s.v[1] - a.v[2], s.v[2], s.v[4] + a.v[0]}},
           {{s.v[3] + a.v[1], s.v[4] - a.v[0], s.v[5]}}}};
}
HWY_INLINE M3 Inverse(const M3& m) {
  const V3 bc = Cross(m.column[1], m.column[2]);
  const V3 ca = Cross(m.column[2], m.column[0]);
  const V3 ab = Cross(m.column[0], m.column[1]);
  const V inverse = hn::Set(Tag(), 1.0) / Dot(m.column[0], bc);
  // Rows of the inverse.
  return Transpose(
      {{Times(inverse, bc), Times(inverse, ca), Times(inverse, ab)}});
}

// (EM-6): column i of y and x belongs to eᵢ, row j to the axis j.
HWY_INLINE M3 SolveTangent(const double* constants, const M3& y) {
  using C = BodyConstants;
  constexpr int kFirst[3] = {0, 1, 2};
  constexpr int kSecond[3] = {1, 2, 0};
  M3 x;
  for (int i = 0; i < 3; ++i) {
    x.column[i].v[i] = Get(constants, C::kInverse + i) * y.column[i].v[i];
    const int m = kFirst[i];
    const int n = kSecond[i];
    const V inverse = Get(constants, C::kInverse + 3 + i);
    const V shear =
        Get(constants, C::kShear + i) * (y.column[m].v[n] - y.column[n].v[m]);
    x.column[m].v[n] =
        inverse * (Get(constants, C::kMoment + n) * y.column[m].v[n] + shear);
    x.column[n].v[m] =
        inverse * (Get(constants, C::kMoment + m) * y.column[n].v[m] - shear);
  }
  return x;
}

// How a step departs from a body at rest in its frame Q (EM-17).
struct Deviation {
  V3 turn;      // φ
  V strain[6];  // ε̄
};

// s v
HWY_INLINE V3 StrainTimes(const V* strain, const V3& v) {
  const V half = hn::Set(Tag(), 0.5);
  const V s01 = half * strain[3];
  const V s12 = half * strain[4];
  const V s20 = half * strain[5];
  return {{strain[0] * v.v[0] + s01 * v.v[1] + s20 * v.v[2],
           s01 * v.v[0] + strain[1] * v.v[1] + s12 * v.v[2],
           s20 * v.v[0] + s12 * v.v[1] + strain[2] * v.v[2]}};
}

// D v
HWY_INLINE V3 Deviate(const Deviation& d, const V3& v) {
  const V two = hn::Set(Tag(), 2.0);
  return Plus(v, Minus(Cross(d.turn, v), Times(two, StrainTimes(d.strain, v))));
}

// (K⁻¹ − K⁻¹ P K⁻¹) y
HWY_INLINE M3 SolveTangent(const double* constants, const M3& y,
                           const Deviation& d, V quarter_time) {
  using C = BodyConstants;
  constexpr int kWith[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  const M3 x = SolveTangent(constants, y);
  const V two = hn::Set(Tag(), 2.0);
  V stress[6];
  for (int k = 0; k < 6; ++k) {
    stress[k] =
        quarter_time * (Get(constants, C::kStiffness + k) * d.strain[k]);
  }
  M3 moved;
  for (int i = 0; i < 3; ++i) {
    const V3 inertia =
        Minus(Cross(d.turn, x.column[i]), StrainTimes(d.strain, x.column[i]));
    moved.column[i] = Times(two * Get(constants, C::kMoment + i), inertia);
    for (int j = 0; j < 3; ++j) {
      moved.column[i] =
          Plus(moved.column[i], Times(stress[kWith[i][j]], x.column[j]));
    }
  }
  return Minus(x, SolveTangent(constants, moved));
}

// (EM-1), for x̄, e₁, e₂, e₃.
struct Motion {
  V3 rate[4];       // w̄
  V3 increment[4];  // Δq
  V3 mean[4];       // q̄
};

HWY_INLINE Motion Move(double time_step, const double* start, const V3* dw) {
  using B = BodyStartBlock;
  const V dt = hn::Set(Tag(), time_step);
  const V half = hn::Set(Tag(), 0.5);
  Motion m;
  for (int a = 0; a < 4; ++a) {
    m.rate[a] = Plus(Get3(start, B::kVelocity + 3 * a),
                     Plus(Get3(start, B::kVelocityCompensation + 3 * a),
                          Times(half, dw[a])));
    m.increment[a] = Times(dt, m.rate[a]);
    V3 rest = Times(half, m.increment[a]);
    if (a > 0) {
      rest = Plus(Get3(start, B::kGradientCompensation + 3 * (a - 1)), rest);
    }
    m.mean[a] = Plus(Get3(start, B::kPosition + 3 * a), rest);
  }
  return m;
}

// (QS-1) for the six strains.
HWY_INLINE void StrainIncrement(const Motion& m, V* strain) {
  constexpr int kFirst[3] = {1, 2, 3};
  constexpr int kSecond[3] = {2, 3, 1};
  for (int i = 0; i < 3; ++i) {
    strain[i] = Dot(m.mean[1 + i], m.increment[1 + i]);
    const int a = kFirst[i];
    const int b = kSecond[i];
    strain[3 + i] =
        Dot(m.mean[a], m.increment[b]) + Dot(m.mean[b], m.increment[a]);
  }
}

HWY_INLINE void GetRateIncrement(const double* iterate, V3* dw) {
  for (int a = 0; a < 4; ++a) {
    dw[a] = Get3(iterate, BodyIterateBlock::kRateIncrement + 3 * a);
  }
}

struct Sums {
  V3 force, moment;
  V work, force_size, moment_size, work_size, rate, energy, weight_work,
      load_work;
};

template <ForwardWork kWork>
HWY_INLINE void AddSums(const double* constants, const double* start,
                        const Motion& m, const V3* residual, const V* magnitude,
                        const V3& weight, Sums* sums) {
  using C = BodyConstants;
  using B = BodyStartBlock;
  sums->force = Plus(sums->force, residual[0]);
  for (int a = 0; a < 4; ++a) {
    sums->moment = Plus(sums->moment, Cross(m.mean[a], residual[a]));
    sums->work = sums->work + Dot(m.rate[a], residual[a]);
  }
  if constexpr (kWork != ForwardWork::kResidual) {
    for (int a = 0; a < 4; ++a) {
      const V size = magnitude[a] * magnitude[a];
      sums->force_size = sums->force_size + size;
      sums->moment_size = sums->moment_size + size * Dot(m.mean[a], m.mean[a]);
      sums->work_size = sums->work_size + size * Dot(m.rate[a], m.rate[a]);
      const V3 w0 = Get3(start, B::kVelocity + 3 * a);
      sums->rate = hn::Max(sums->rate, hn::Max(MaxAbs(w0), MaxAbs(m.rate[a])));
    }
    for (int i = 0; i < 3; ++i) {
      sums->weight_work =
          sums->weight_work + hn::Abs(weight.v[i]) * hn::Abs(m.rate[0].v[i]);
    }
  }
  if constexpr (kWork == ForwardWork::kFactorize) {
    const V half = hn::Set(Tag(), 0.5);
    const V3 w0 = Get3(start, B::kVelocity);
    V energy = Get(constants, C::kMass) * Dot(w0, w0);
    for (int i = 0; i < 3; ++i) {
      const V3 rate = Get3(start, B::kVelocity + 3 * (i + 1));
      energy = energy + Get(constants, C::kMoment + i) * Dot(rate, rate);
    }
    for (int k = 0; k < 6; ++k) {
      const V strain = Get(start, B::kStrain + k);
      energy = energy + Get(constants, C::kStiffness + k) * (strain * strain);
    }
    sums->energy = sums->energy + half * energy;
  }
}

// φ, a quarter of the step's turn, in the frame.
HWY_INLINE V3 QuarterTurn(const M3& frame, const Motion& m) {
  const V eighth = hn::Set(Tag(), 0.125);
  V3 turn;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    turn.v[i] = eighth * (Dot(frame.column[k], m.increment[1 + j]) -
                          Dot(frame.column[j], m.increment[1 + k]));
  }
  return turn;
}

HWY_INLINE void PutDeviation(const Deviation& d, float* place) {
  Put3(d.turn, place, BodyFrameBlock::kTurn);
  for (int k = 0; k < 6; ++k) {
    Put(d.strain[k], place, BodyFrameBlock::kStrain + k);
  }
}
HWY_INLINE Deviation GetDeviation(const float* place) {
  Deviation d;
  d.turn = Get3(place, BodyFrameBlock::kTurn);
  for (int k = 0; k < 6; ++k) {
    d.strain[k] = Get(place, BodyFrameBlock::kStrain + k);
  }
  return d;
}

// Of the constants of one of a body's two joints.
struct OwnOffsets {
  int compliance, turn, strain;
};
constexpr OwnOffsets kOwnLeft = {BodyConstants::kLeftCompliance,
                                 BodyConstants::kLeftTurn,
                                 BodyConstants::kLeftStrain};
constexpr OwnOffsets kOwnRight = {BodyConstants::kRightCompliance,
                                  BodyConstants::kRightTurn,
                                  BodyConstants::kRightStrain};

// What a body gives to the block of one joint, (EM-15) with (EM-17): linear in
// φ and s, as what is second order in them is left to the iteration.
HWY_INLINE M3 OwnBlock(const double* constants, const OwnOffsets& at,
                       const M3& frame, const Deviation& d) {
  Symmetric own = GetSymmetric(constants, at.compliance);
  for (int k = 0; k < 6; ++k) {
    for (int i = 0; i < 6; ++i) {
      own.v[i] = own.v[i] + d.strain[k] * Get(constants, at.strain + 6 * k + i);
    }
  }
  return WithSkew(Turned(frame, own),
                  Times(frame, Times(GetMatrix(constants, at.turn), d.turn)));
}

// And to those of its two joints with each other: row right and column left,
// row left and column right.
HWY_INLINE void CrossBlocks(const double* constants, const M3& frame,
                            const Deviation& d, M3* below, M3* above) {
  using C = BodyConstants;
  M3 even = GetMatrix(constants, C::kCrossCompliance);
  for (int k = 0; k < 6; ++k) {
    for (int c = 0; c < 3; ++c) {
      even.column[c] = Plus(
          even.column[c],
          Times(d.strain[k], Get3(constants, C::kCrossStrain + 9 * k + 3 * c)));
    }
  }
  M3 odd;
  for (int c = 0; c < 3; ++c) {
    odd.column[c] = Plus(
        Plus(Times(d.turn.v[0], Get3(constants, C::kCrossTurn + 3 * c)),
             Times(d.turn.v[1], Get3(constants, C::kCrossTurn + 9 + 3 * c))),
        Times(d.turn.v[2], Get3(constants, C::kCrossTurn + 18 + 3 * c)));
  }
  *below = Turned(frame, Plus(even, odd));
  *above = Turned(frame, Transpose(Minus(even, odd)));
}

template <ForwardWork kWork, bool kRow>
HWY_INLINE void Forward(const ChainGroup& g, int lane) {
  using C = BodyConstants;
  using B = BodyStartBlock;
  using P = PieceBlock;
  constexpr bool kFactorize = kWork == ForwardWork::kFactorize;
  constexpr bool kSizes = kWork != ForwardWork::kResidual;
  const Tag tag;
  const V dt = hn::Set(tag, g.time_step);
  const V half = hn::Set(tag, 0.5);
  const V quarter = hn::Set(tag, 0.25);
  const V quarter_time = hn::Set(tag, 0.25 * g.time_step * g.time_step);
  const V two = hn::Set(tag, 2.0);
  const V shift = hn::Set(tag, g.shift);
  const V zero = hn::Zero(tag);
  double* const piece = g.piece + lane;

  Sums sums = {Zero3(), Zero3(), zero, zero, zero,
               zero,    zero,    zero, zero, zero};
  V3 left_impulse = Get3(piece, P::kLeftImpulse);
  // Of the joint on the left: what the body before gave, and what eliminating
  // the joint before that took away.
  V3 side = Zero3();
  V3 rate = Zero3();
  V3 rest = Zero3();
  const M3 zero_matrix = {{Zero3(), Zero3(), Zero3()}};
  M3 matrix = zero_matrix;
  // Of the joint at the left end of the piece; with its column and row in the
  // equations of the joint in hand.
  V3 end_side = Zero3();
  M3 end_matrix = zero_matrix;
  M3 end_column = zero_matrix;
  M3 end_row = zero_matrix;

  for (int t = 0; t < g.length; ++t) {
    const double* const constants = g.constants[t] + lane;
    const double* const start =
        g.start + static_cast<ptrdiff_t>(t) * B::kSize * kPackLanes + lane;
    double* const iterate =
        g.iterate +
        static_cast<ptrdiff_t>(t) * BodyIterateBlock::kSize * kPackLanes + lane;
    double* const scratch =
        g.scratch +
        static_cast<ptrdiff_t>(t) * BodyScratchBlock::kSize * kPackLanes + lane;
    float* const kept_frame =
        g.frames +
        static_cast<ptrdiff_t>(t) * BodyFrameBlock::kSize * kPackLanes + lane;
    // Of the joint on the left.
    const ptrdiff_t before = t > 0 ? t - 1 : 0;
    float* const factor =
        g.factor + before * JointFactorBlock::kSize * kPackLanes + lane;
    double* const left_scratch =
        g.scratch + before * BodyScratchBlock::kSize * kPackLanes + lane;

    V3 dw[4];
    GetRateIncrement(iterate, dw);
    const V3 impulse = Get3(iterate, BodyIterateBlock::kImpulse);
    const Motion m = Move(g.time_step, start, dw);

    // Inertia.
    V3 residual[4];
    V magnitude[4];
    residual[0] = Times(Get(constants, C::kMass), dw[0]);
    for (int i = 0; i < 3; ++i) {
      residual[1 + i] = Times(Get(constants, C::kMoment + i), dw[1 + i]);
    }
    if constexpr (kSizes) {
      for (int a = 0; a < 4; ++a) magnitude[a] = MaxAbs(residual[a]);
    }
    // Impulses of weight and loads.
    V3 weight;
    for (int i = 0; i < 3; ++i) {
      weight.v[i] =
          dt * (Get(constants, C::kMass) * hn::Set(tag, g.gravity[i]));
    }
    residual[0] = Minus(residual[0], weight);
    if (g.loads != nullptr) {
      const double* const loads =
          g.loads + static_cast<ptrdiff_t>(t) * 12 * kPackLanes + lane;
      for (int a = 0; a < 4; ++a) {
        const V3 impulse_a = Get3(loads, 3 * a);
        residual[a] = Minus(residual[a], impulse_a);
        if constexpr (kSizes) {
          magnitude[a] = magnitude[a] + MaxAbs(impulse_a);
          sums.load_work = sums.load_work + Dot(m.rate[a], impulse_a);
        }
      }
    }
    // (ANCF-6) with mean vectors and mean strain.
    Deviation deviation;
    V stress[6];
    StrainIncrement(m, stress);
    for (int k = 0; k < 6; ++k) {
      const V mean =
          Get(start, B::kStrain + k) +
          (Get(start, B::kStrainCompensation + k) + half * stress[k]);
      deviation.strain[k] = mean;
      stress[k] = Get(constants, C::kStiffness + k) * mean;
    }
    const V3& e1 = m.mean[1];
    const V3& e2 = m.mean[2];
    const V3& e3 = m.mean[3];
    const V3 force[3] = {Plus(Plus(Times(stress[0], e1), Times(stress[3], e2)),
                              Times(stress[5], e3)),
                         Plus(Plus(Times(stress[1], e2), Times(stress[3], e1)),
                              Times(stress[4], e3)),
                         Plus(Plus(Times(stress[2], e3), Times(stress[4], e2)),
                              Times(stress[5], e1))};
    for (int i = 0; i < 3; ++i) {
      const V3 internal = Times(dt, force[i]);
      residual[1 + i] = Plus(residual[1 + i], internal);
      if constexpr (kSizes) {
        magnitude[1 + i] = magnitude[1 + i] + MaxAbs(internal);
      }
    }
    // Joints.
    V left[4];
    V right[4];
    if constexpr (kRow) {
      for (int a = 0; a < 4; ++a) {
        left[a] = Get(constants, C::kLeftWeight + a);
        right[a] = Get(constants, C::kRightWeight + a);
        residual[a] = Plus(residual[a], Plus(Times(left[a], left_impulse),
                                             Times(right[a], impulse)));
      }
    }
    if constexpr (kRow && kSizes) {
      const V left_size = MaxAbs(left_impulse);
      const V right_size = MaxAbs(impulse);
      for (int a = 0; a < 4; ++a) {
        magnitude[a] = magnitude[a] + (hn::Abs(left[a]) * left_size +
                                       hn::Abs(right[a]) * right_size);
      }
    }
    AddSums<kWork>(constants, start, m, residual, magnitude, weight, &sums);
    left_impulse = impulse;

    // u = K⁻¹ r.
    M3 frame;
    for (int i = 0; i < 3; ++i) {
      frame.column[i] = Plus(m.mean[1 + i], Times(quarter, m.increment[1 + i]));
    }
    PutMatrix(frame, kept_frame, BodyFrameBlock::kFrame);
    V3 u[4];
    u[0] = Times(Get(constants, C::kInverseMass), residual[0]);
    if constexpr (kRow) {
      deviation.turn = QuarterTurn(frame, m);
      PutDeviation(deviation, kept_frame);
      M3 along;
      for (int i = 0; i < 3; ++i) {
        along.column[i] =
            Deviate(deviation, TransposeTimes(frame, residual[1 + i]));
      }
      const M3 solved = SolveTangent(constants, along, deviation, quarter_time);
      for (int i = 0; i < 3; ++i) {
        u[1 + i] = Times(frame, Deviate(deviation, solved.column[i]));
      }
    } else {
      // Along ē, then along the vectors of the end, see (EM-6).
      const M3 mean = {{m.mean[1], m.mean[2], m.mean[3]}};
      M3 end;
      M3 along;
      for (int i = 0; i < 3; ++i) {
        end.column[i] = Plus(mean.column[i], Times(half, m.increment[1 + i]));
        along.column[i] = TransposeTimes(mean, residual[1 + i]);
      }
      const M3 solved = SolveTangent(constants, along);
      for (int i = 0; i < 3; ++i) u[1 + i] = Times(end, solved.column[i]);
    }
    for (int a = 0; a < 4; ++a) {
      Put3(u[a], scratch, BodyScratchBlock::kCorrection + 3 * a);
    }
    if constexpr (!kRow) continue;

    // What this body gives to the joints on either side.
    V3 left_side = Times(left[0], u[0]);
    V3 right_side = Times(right[0], u[0]);
    V3 left_rate = Zero3();
    V3 right_rate = Zero3();
    V3 left_rest = Zero3();
    V3 right_rest = Zero3();
    for (int a = 0; a < 4; ++a) {
      if (a > 0) {
        left_side = Plus(left_side, Times(left[a], u[a]));
        right_side = Plus(right_side, Times(right[a], u[a]));
      }
      const V3 w0 = Get3(start, B::kVelocity + 3 * a);
      const V3 small = Plus(Get3(start, B::kVelocityCompensation + 3 * a),
                            Times(half, dw[a]));
      left_rate = Plus(left_rate, Times(left[a], w0));
      right_rate = Plus(right_rate, Times(right[a], w0));
      left_rest = Plus(left_rest, Times(left[a], small));
      right_rest = Plus(right_rest, Times(right[a], small));
    }
    if (t == 0) {
      Put3(left_side, piece, P::kLeftSide);
      Put3(left_rate, piece, P::kLeftRate);
      Put3(left_rest, piece, P::kLeftRest);
      if constexpr (kFactorize) {
        end_matrix = OwnBlock(constants, kOwnLeft, frame, deviation);
        matrix = OwnBlock(constants, kOwnRight, frame, deviation);
        CrossBlocks(constants, frame, deviation, &end_column, &end_row);
      }
      side = right_side;
    } else {
      // The joint on the left is complete.
      const V3 closing = Plus(Plus(rate, left_rate), Plus(rest, left_rest));
      const V3 y = Minus(Plus(side, left_side), Times(two, closing));
      M3 inverse;
      M3 below;
      M3 at_start;
      if constexpr (kFactorize) {
        M3 diagonal =
            Plus(matrix, OwnBlock(constants, kOwnLeft, frame, deviation));
        for (int i = 0; i < 3; ++i) {
          diagonal.column[i].v[i] = diagonal.column[i].v[i] + shift;
        }
        M3 above;
        CrossBlocks(constants, frame, deviation, &below, &above);
        inverse = Inverse(diagonal);
        at_start = end_row;
        const M3 next = Times(inverse, above);
        const M3 start_tie = Times(inverse, end_column);
        PutMatrix(inverse, factor, JointFactorBlock::kInverse);
        PutMatrix(below, factor, JointFactorBlock::kBelow);
        PutMatrix(at_start, factor, JointFactorBlock::kAtStart);
        PutMatrix(next, factor, JointFactorBlock::kNext);
        PutMatrix(start_tie, factor, JointFactorBlock::kStart);
        matrix = Minus(OwnBlock(constants, kOwnRight, frame, deviation),
                       Times(below, next));
        end_matrix = Minus(end_matrix, Times(end_row, start_tie));
        end_column = Minus(zero_matrix, Times(below, start_tie));
        end_row = Minus(zero_matrix, Times(end_row, next));
      } else {
        inverse = GetMatrix(factor, JointFactorBlock::kInverse);
        below = GetMatrix(factor, JointFactorBlock::kBelow);
        at_start = GetMatrix(factor, JointFactorBlock::kAtStart);
      }
      const V3 solution = Times(inverse, y);
      Put3(solution, left_scratch, BodyScratchBlock::kJoint);
      side = Minus(right_side, Times(below, solution));
      end_side = Minus(end_side, Times(at_start, solution));
    }
    rate = right_rate;
    rest = right_rest;
  }

  if constexpr (kRow) {
    Put3(side, piece, P::kRightSide);
    Put3(rate, piece, P::kRightRate);
    Put3(rest, piece, P::kRightRest);
    Put3(Plus(Get3(piece, P::kLeftSide), end_side), piece, P::kLeftSide);
  }
  if constexpr (kRow && kFactorize) {
    PutMatrix(matrix, piece, P::kRightMatrix);
    PutMatrix(end_matrix, piece, P::kLeftMatrix);
    PutMatrix(end_column, piece, P::kBelow);
    PutMatrix(end_row, piece, P::kAbove);
  }
  if constexpr (kFactorize) Put(sums.energy, piece, P::kEnergy);
  Put3(sums.force, piece, P::kForce);
  Put3(sums.moment, piece, P::kMoment);
  Put(sums.work, piece, P::kWork);
  if constexpr (kSizes) {
    Put(sums.force_size, piece, P::kForceSize);
    Put(sums.moment_size, piece, P::kMomentSize);
    Put(sums.work_size, piece, P::kWorkSize);
    Put(sums.rate, piece, P::kRate);
    Put(sums.weight_work, piece, P::kWeightWork);
    Put(sums.load_work, piece, P::kLoadWork);
  }
}

// δw = u − K⁻¹ p; `centre` is M times the second term for x̄, `solved` that
// along the frame for the eᵢ.
HWY_INLINE void CorrectBody(const double* constants, const double* scratch,
                            const M3& frame, const V3& centre, const M3& solved,
                            double* iterate, V* largest, V* sum) {
  V3 change[4];
  change[0] = Times(Get(constants, BodyConstants::kInverseMass), centre);
  for (int i = 0; i < 3; ++i) change[1 + i] = Times(frame, solved.column[i]);
  for (int a = 0; a < 4; ++a) {
    const V3 step =
        Minus(Get3(scratch, BodyScratchBlock::kCorrection + 3 * a), change[a]);
    *largest = hn::Max(*largest, MaxAbs(step));
    *sum = *sum + (step.v[0] + step.v[1] + step.v[2]);
    const int k = BodyIterateBlock::kRateIncrement + 3 * a;
    Put3(Minus(Get3(iterate, k), step), iterate, k);
  }
}

HWY_INLINE void Backward(const ChainGroup& g, int lane) {
  using C = BodyConstants;
  using P = PieceBlock;
  double* const piece = g.piece + lane;
  V3 right_step = Get3(piece, P::kRightStep);
  const V3 end_step = Get3(piece, P::kLeftStep);
  const V quarter_time = hn::Set(Tag(), 0.25 * g.time_step * g.time_step);
  V largest = hn::Zero(Tag());
  V sum = hn::Zero(Tag());
  for (ptrdiff_t t = g.length - 1; t >= 0; --t) {
    const double* const constants = g.constants[t] + lane;
    double* const iterate =
        g.iterate + t * BodyIterateBlock::kSize * kPackLanes + lane;
    const double* const scratch =
        g.scratch + t * BodyScratchBlock::kSize * kPackLanes + lane;
    const float* const kept_frame =
        g.frames + t * BodyFrameBlock::kSize * kPackLanes + lane;
    V3 left_step = end_step;
    if (t > 0) {
      const float* const factor =
          g.factor + (t - 1) * JointFactorBlock::kSize * kPackLanes + lane;
      const V3 y = Get3(scratch - BodyScratchBlock::kSize * kPackLanes,
                        BodyScratchBlock::kJoint);
      left_step = Minus(
          Minus(y,
                Times(GetMatrix(factor, JointFactorBlock::kNext), right_step)),
          Times(GetMatrix(factor, JointFactorBlock::kStart), end_step));
    }
    Put3(Minus(Get3(iterate, BodyIterateBlock::kImpulse), right_step), iterate,
         BodyIterateBlock::kImpulse);
    const M3 frame = GetMatrix(kept_frame, BodyFrameBlock::kFrame);
    const Deviation d = GetDeviation(kept_frame);
    const V3 left_force = Deviate(d, TransposeTimes(frame, left_step));
    const V3 right_force = Deviate(d, TransposeTimes(frame, right_step));
    M3 load;
    for (int i = 0; i < 3; ++i) {
      load.column[i] =
          Plus(Times(Get(constants, C::kLeftWeight + 1 + i), left_force),
               Times(Get(constants, C::kRightWeight + 1 + i), right_force));
    }
    const V3 centre = Plus(Times(Get(constants, C::kLeftWeight), left_step),
                           Times(Get(constants, C::kRightWeight), right_step));
    M3 solved = SolveTangent(constants, load, d, quarter_time);
    for (int i = 0; i < 3; ++i) {
      solved.column[i] = Deviate(d, solved.column[i]);
    }
    CorrectBody(constants, scratch, frame, centre, solved, iterate, &largest,
                &sum);
    right_step = left_step;
  }
  Put(largest, piece, P::kCorrection);
  Put(sum, piece, P::kCorrectionSum);
}

// Bodies alone: p is where the loads were.
HWY_INLINE void BackwardBodies(const ChainGroup& g, int lane) {
  V largest = hn::Zero(Tag());
  V sum = hn::Zero(Tag());
  for (ptrdiff_t t = 0; t < g.length; ++t) {
    const double* const loads = g.loads + t * 12 * kPackLanes + lane;
    double* const iterate =
        g.iterate + t * BodyIterateBlock::kSize * kPackLanes + lane;
    const double* const scratch =
        g.scratch + t * BodyScratchBlock::kSize * kPackLanes + lane;
    const M3 frame =
        GetMatrix(g.frames + t * BodyFrameBlock::kSize * kPackLanes + lane,
                  BodyFrameBlock::kFrame);
    M3 load;
    for (int i = 0; i < 3; ++i) {
      load.column[i] = TransposeTimes(frame, Get3(loads, 3 + 3 * i));
    }
    const double* const constants = g.constants[t] + lane;
    CorrectBody(constants, scratch, frame, Get3(loads, 0),
                SolveTangent(constants, load), iterate, &largest, &sum);
  }
  Put(largest, g.piece + lane, PieceBlock::kCorrection);
  Put(sum, g.piece + lane, PieceBlock::kCorrectionSum);
}

HWY_INLINE void Finish(const ChainGroup& g, int lane) {
  for (ptrdiff_t t = 0; t < g.length; ++t) {
    const double* const start =
        g.start + t * BodyStartBlock::kSize * kPackLanes + lane;
    const double* const iterate =
        g.iterate + t * BodyIterateBlock::kSize * kPackLanes + lane;
    double* const scratch =
        g.scratch + t * BodyScratchBlock::kSize * kPackLanes + lane;
    V3 dw[4];
    GetRateIncrement(iterate, dw);
    const Motion m = Move(g.time_step, start, dw);
    V strain[6];
    StrainIncrement(m, strain);
    for (int a = 0; a < 4; ++a) {
      Put3(m.increment[a], scratch,
           BodyScratchBlock::kPositionIncrement + 3 * a);
    }
    for (int k = 0; k < 6; ++k) {
      Put(strain[k], scratch, BodyScratchBlock::kStrainIncrement + k);
    }
  }
}

// Of the numbers that one body has next to each other.
using ShortTag = hn::CappedTag<double, kErrorLanes>;
using ShortV = hn::Vec<ShortTag>;
constexpr int kShort = static_cast<int>(hn::MaxLanes(ShortTag()));

// (SUM-2)
HWY_INLINE void Advance(ShortV increment, double* value, double* compensation) {
  const ShortTag tag;
  const ShortV a = hn::LoadU(tag, value);
  const ShortV b = increment + hn::LoadU(tag, compensation);
  const ShortV sum = a + b;
  const ShortV b_part = sum - a;
  const ShortV a_part = sum - b_part;
  hn::StoreU(sum, tag, value);
  hn::StoreU((a - a_part) + (b - b_part), tag, compensation);
}

void CommitOneBody(const double* scratch, const double* iterate, int lane,
                   double time_step, int order, const BodyPlace& place,
                   double* errors) {
  const ShortTag tag;
  HWY_ALIGN double dq[12];
  HWY_ALIGN double dw[12];
  HWY_ALIGN double strain[8];
  for (int i = 0; i < 12; ++i) {
    dq[i] =
        scratch[(BodyScratchBlock::kPositionIncrement + i) * kPackLanes + lane];
    dw[i] = iterate[(BodyIterateBlock::kRateIncrement + i) * kPackLanes + lane];
  }
  for (int k = 0; k < 6; ++k) {
    strain[k] =
        scratch[(BodyScratchBlock::kStrainIncrement + k) * kPackLanes + lane];
  }
  for (int i = 0; i < 12; i += kShort) {
    Advance(hn::Load(tag, dq + i), place.value[0] + i,
            place.compensation[0] + i);
    Advance(hn::Load(tag, dw + i), place.value[1] + i,
            place.compensation[1] + i);
  }
  // Six are no multiple of four.
  constexpr int kWhole = 6 - 6 % kShort;
  for (int k = 0; k < kWhole; k += kShort) {
    Advance(hn::Load(tag, strain + k), place.value[2] + k,
            place.compensation[2] + k);
  }
  for (int k = kWhole; k < 6; ++k) {
    AddCompensated(strain[k], place.value[2][k], place.compensation[2][k]);
  }
  const ShortV dt = hn::Set(tag, time_step);
  for (int i = 0; i < 12; i += kShort) {
    ShortV now[5];
    now[0] = hn::Load(tag, dw + i) / dt;
    for (int j = 0; j < 4; ++j) {
      double* const differences =
          place.differences + j * place.order_stride + i;
      now[j + 1] = now[j] - hn::LoadU(tag, differences);
      hn::StoreU(now[j], tag, differences);
      double* const error = errors + kErrorLanes * j;
      hn::StoreU(hn::Max(hn::LoadU(tag, error), hn::Abs(now[j + 1])), tag,
                 error);
    }
    ShortV sum = hn::Zero(tag);
    for (int j = order; j >= 0; --j) sum = sum + now[j];
    hn::StoreU(sum, tag, place.next + i);
  }
}

template <ForwardWork kWork>
HWY_INLINE void ForwardLanes(const ChainGroup& group) {
  for (int lane = 0; lane < kPackLanes; lane += kStep) {
    if (group.factor != nullptr) {
      Forward<kWork, true>(group, lane);
    } else {
      Forward<kWork, false>(group, lane);
    }
  }
}
void ForwardFactorize(const ChainGroup& group) {
  ForwardLanes<ForwardWork::kFactorize>(group);
}
void ForwardSizes(const ChainGroup& group) {
  ForwardLanes<ForwardWork::kSizes>(group);
}
void ForwardResidual(const ChainGroup& group) {
  ForwardLanes<ForwardWork::kResidual>(group);
}
void BackwardLanes(const ChainGroup& group) {
  for (int lane = 0; lane < kPackLanes; lane += kStep) {
    if (group.factor != nullptr) {
      Backward(group, lane);
    } else {
      BackwardBodies(group, lane);
    }
  }
}
void FinishLanes(const ChainGroup& group) {
  for (int lane = 0; lane < kPackLanes; lane += kStep) Finish(group, lane);
}

}  // namespace HWY_NAMESPACE
}  // namespace emmy
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace emmy {

HWY_EXPORT(ForwardFactorize);
HWY_EXPORT(ForwardSizes);
HWY_EXPORT(ForwardResidual);
HWY_EXPORT(BackwardLanes);
HWY_EXPORT(FinishLanes);
HWY_EXPORT(CommitOneBody);

void ChainForward(const ChainGroup& group, ForwardWork work) {
  switch (work) {
    case ForwardWork::kFactorize:
      HWY_DYNAMIC_DISPATCH(ForwardFactorize)(group);
      return;
    case ForwardWork::kSizes:
      HWY_DYNAMIC_DISPATCH(ForwardSizes)(group);
      return;
    case ForwardWork::kResidual:
      HWY_DYNAMIC_DISPATCH(ForwardResidual)(group);
      return;
  }
}

void ChainBackward(const ChainGroup& group) {
  HWY_DYNAMIC_DISPATCH(BackwardLanes)(group);
}

void ChainFinish(const ChainGroup& group) {
  HWY_DYNAMIC_DISPATCH(FinishLanes)(group);
}

void CommitBody(const double* scratch, const double* iterate, int lane,
                double time_step, int order, const BodyPlace& place,
                double* errors) {
  HWY_DYNAMIC_DISPATCH(CommitOneBody)
  (scratch, iterate, lane, time_step, order, place, errors);
}

}  // namespace emmy
#endif  // HWY_ONCE
