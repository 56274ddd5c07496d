// Compiled once for each instruction set: Highway includes this file again
// from foreach_target.h.

#include "emmy/numerics/panel_product.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "emmy/numerics/panel_product.cc"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
//
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace emmy {
namespace HWY_NAMESPACE {

// Calls product(whether there is a panel to fetch, its address). The address
// is a number, since what is fetched may go past the end of all panels.
template <typename Scalar, typename Product>
HWY_INLINE void WithOrWithoutPrefetch(const Scalar* next,
                                      const Product& product) {
  if (next == nullptr) {
    product(std::false_type(), 0);
  } else {
    product(std::true_type(), reinterpret_cast<std::uintptr_t>(next));
  }
}

#if HWY_TARGET == HWY_SCALAR

// Without vectors: the order of the sums that the other targets follow.
template <bool kPrefetch, typename Scalar>
void Times(const Scalar* panel, int rows, int columns, const Scalar* x,
           Scalar* y, std::uintptr_t /*next*/) {
  std::fill_n(y, rows, Scalar(0));
  for (int c = 0; c < columns; ++c) {
    for (int r = 0; r < rows; ++r) y[r] += x[c] * panel[r];
    panel += rows;
  }
}

template <bool kPrefetch, typename Scalar>
void TransposedTimes(const Scalar* panel, int rows, int columns,
                     const Scalar* x, Scalar* y, std::uintptr_t /*next*/) {
  constexpr int kBlock = 64 / static_cast<int>(sizeof(Scalar));
  constexpr int kUnit = kPanelRowUnit<Scalar>;
  const int blocked = rows - rows % kBlock;
  for (int c = 0; c < columns; ++c) {
    Scalar sum[static_cast<size_t>(kBlock)] = {};
    for (int r = 0; r < blocked; ++r) sum[r % kBlock] += x[r] * panel[r];
    for (int half = kBlock / 2; half >= kUnit; half /= 2) {
      for (int k = 0; k < half; ++k) sum[k] += sum[k + half];
    }
    for (int r = blocked; r < rows; ++r) sum[r % kUnit] += x[r] * panel[r];
    for (int half = kUnit / 2; half > 0; half /= 2) {
      for (int k = 0; k < half; ++k) sum[k] += sum[k + half];
    }
    y[c] = sum[0];
    panel += rows;
  }
}

#else

namespace hn = hwy::HWY_NAMESPACE;

// The line of 64 bytes at `address`, to where the next panel will find it.
HWY_INLINE void PrefetchToSecondLevel(std::uintptr_t address) {
  // A number, as it may lie beyond the panels.
  // NOLINTNEXTLINE(performance-no-int-to-ptr)
  __builtin_prefetch(reinterpret_cast<const void*>(address), 0, 2);
}

// The sums of a block of 64 bytes are kept in as many vectors as it takes.
template <typename Scalar>
using Tag = hn::CappedTag<Scalar, 64 / sizeof(Scalar)>;
template <typename Scalar>
using QuarterTag = hn::FixedTag<Scalar, 16 / sizeof(Scalar)>;

template <typename Scalar, int kBlocks, bool kPrefetch>
HWY_INLINE void TimesRows(const Scalar* HWY_RESTRICT panel, int rows,
                          int columns, const Scalar* HWY_RESTRICT x,
                          Scalar* HWY_RESTRICT y, std::uintptr_t next) {
  const Tag<Scalar> tag;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag<Scalar>()));
  constexpr int kVectors =
      kBlocks * 64 / static_cast<int>(sizeof(Scalar)) / kLanes;
  hn::Vec<Tag<Scalar>> sum[size_t{kVectors}];
  for (auto& s : sum) s = hn::Zero(tag);
  for (int c = 0; c < columns; ++c) {
    if constexpr (kPrefetch) {
      for (int k = 0; k < kBlocks; ++k, next += 64) PrefetchToSecondLevel(next);
    }
    const auto factor = hn::Set(tag, x[c]);
    for (int k = 0; k < kVectors; ++k) {
      sum[k] =
          hn::Add(sum[k], hn::Mul(factor, hn::LoadU(tag, panel + k * kLanes)));
    }
    panel += rows;
  }
  for (int k = 0; k < kVectors; ++k) hn::StoreU(sum[k], tag, y + k * kLanes);
}

template <bool kPrefetch, typename Scalar>
HWY_INLINE void Times(const Scalar* HWY_RESTRICT panel, int rows, int columns,
                      const Scalar* HWY_RESTRICT x, Scalar* HWY_RESTRICT y,
                      std::uintptr_t next) {
  constexpr int kBlock = 64 / static_cast<int>(sizeof(Scalar));
  const size_t bytes = size_t{64} * static_cast<size_t>(columns);  // A block.
  int row = 0;
  for (; row + 4 * kBlock <= rows; row += 4 * kBlock, next += 4 * bytes) {
    TimesRows<Scalar, 4, kPrefetch>(panel + row, rows, columns, x, y + row,
                                    next);
  }
  for (; row + kBlock <= rows; row += kBlock, next += bytes) {
    TimesRows<Scalar, 1, kPrefetch>(panel + row, rows, columns, x, y + row,
                                    next);
  }
  const QuarterTag<Scalar> tag;
  for (; row < rows; row += kPanelRowUnit<Scalar>) {
    auto sum = hn::Zero(tag);
    for (int c = 0; c < columns; ++c) {
      const Scalar* const column = panel + static_cast<ptrdiff_t>(c) * rows;
      sum = hn::Add(sum,
                    hn::Mul(hn::Set(tag, x[c]), hn::LoadU(tag, column + row)));
    }
    hn::StoreU(sum, tag, y + row);
  }
}

// The sum of a block's vectors in halves, down to 16 bytes.
template <typename Scalar, int kVectors>
HWY_INLINE hn::Vec<QuarterTag<Scalar>> Quarter(hn::Vec<Tag<Scalar>>* sum) {
  for (int half = kVectors / 2; half > 0; half /= 2) {
    for (int k = 0; k < half; ++k) sum[k] = hn::Add(sum[k], sum[k + half]);
  }
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag<Scalar>()));
  constexpr int kUnit = kPanelRowUnit<Scalar>;
  if constexpr (kLanes == kUnit) {
    return sum[0];
  } else if constexpr (kLanes == 2 * kUnit) {
    const hn::Half<Tag<Scalar>> half;
    return hn::Add(hn::LowerHalf(half, sum[0]), hn::UpperHalf(half, sum[0]));
  } else {
    const hn::Half<Tag<Scalar>> half;
    const auto both =
        hn::Add(hn::LowerHalf(half, sum[0]), hn::UpperHalf(half, sum[0]));
    const hn::Half<hn::Half<Tag<Scalar>>> quarter;
    return hn::Add(hn::LowerHalf(quarter, both), hn::UpperHalf(quarter, both));
  }
}

template <typename Scalar, int kColumns, bool kPrefetch>
HWY_INLINE void TransposedColumns(const Scalar* HWY_RESTRICT panel, int rows,
                                  const Scalar* HWY_RESTRICT x,
                                  Scalar* HWY_RESTRICT y, std::uintptr_t next) {
  const Tag<Scalar> tag;
  const QuarterTag<Scalar> quarter_tag;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag<Scalar>()));
  constexpr int kBlock = 64 / static_cast<int>(sizeof(Scalar));
  constexpr int kVectors = kBlock / kLanes;
  constexpr int kUnit = kPanelRowUnit<Scalar>;
  hn::Vec<Tag<Scalar>> sum[size_t{kColumns}][size_t{kVectors}];
  for (auto& column : sum) {
    for (auto& s : column) s = hn::Zero(tag);
  }
  int row = 0;
  for (; row + kBlock <= rows; row += kBlock) {
    if constexpr (kPrefetch) {
      for (int c = 0; c < kColumns; ++c, next += 64) {
        PrefetchToSecondLevel(next);
      }
    }
    for (int k = 0; k < kVectors; ++k) {
      const auto factor = hn::LoadU(tag, x + row + k * kLanes);
      for (int c = 0; c < kColumns; ++c) {
        const Scalar* const column = panel + static_cast<ptrdiff_t>(c) * rows;
        sum[c][k] =
            hn::Add(sum[c][k],
                    hn::Mul(factor, hn::LoadU(tag, column + row + k * kLanes)));
      }
    }
  }
  hn::Vec<QuarterTag<Scalar>> total[size_t{kColumns}];
  for (int c = 0; c < kColumns; ++c) {
    total[c] = Quarter<Scalar, kVectors>(sum[c]);
  }
  for (; row < rows; row += kUnit) {
    const auto factor = hn::LoadU(quarter_tag, x + row);
    for (int c = 0; c < kColumns; ++c) {
      const Scalar* const column = panel + static_cast<ptrdiff_t>(c) * rows;
      total[c] = hn::Add(total[c],
                         hn::Mul(factor, hn::LoadU(quarter_tag, column + row)));
    }
  }
  for (int c = 0; c < kColumns; ++c) {
    HWY_ALIGN Scalar lanes[size_t{kUnit}];
    hn::Store(total[c], quarter_tag, lanes);
    if constexpr (kUnit == 4) {
      y[c] = (lanes[0] + lanes[2]) + (lanes[1] + lanes[3]);
    } else {
      y[c] = lanes[0] + lanes[1];
    }
  }
}

template <bool kPrefetch, typename Scalar>
HWY_INLINE void TransposedTimes(const Scalar* HWY_RESTRICT panel, int rows,
                                int columns, const Scalar* HWY_RESTRICT x,
                                Scalar* HWY_RESTRICT y, std::uintptr_t next) {
  const size_t bytes = sizeof(Scalar) * static_cast<size_t>(rows);  // A column.
  int column = 0;
  for (; column + 4 <= columns; column += 4, next += 4 * bytes) {
    TransposedColumns<Scalar, 4, kPrefetch>(
        panel + static_cast<ptrdiff_t>(column) * rows, rows, x, y + column,
        next);
  }
  for (; column < columns; ++column, next += bytes) {
    TransposedColumns<Scalar, 1, kPrefetch>(
        panel + static_cast<ptrdiff_t>(column) * rows, rows, x, y + column,
        next);
  }
}

#endif  // HWY_TARGET == HWY_SCALAR

void TimesFloat(const float* panel, int rows, int columns, const float* x,
                float* y, const float* next) {
  WithOrWithoutPrefetch(next, [&](auto prefetch, std::uintptr_t address) {
    Times<prefetch>(panel, rows, columns, x, y, address);
  });
}
void TimesDouble(const double* panel, int rows, int columns, const double* x,
                 double* y, const double* next) {
  WithOrWithoutPrefetch(next, [&](auto prefetch, std::uintptr_t address) {
    Times<prefetch>(panel, rows, columns, x, y, address);
  });
}
void TransposedTimesFloat(const float* panel, int rows, int columns,
                          const float* x, float* y, const float* next) {
  WithOrWithoutPrefetch(next, [&](auto prefetch, std::uintptr_t address) {
    TransposedTimes<prefetch>(panel, rows, columns, x, y, address);
  });
}
void TransposedTimesDouble(const double* panel, int rows, int columns,
                           const double* x, double* y, const double* next) {
  WithOrWithoutPrefetch(next, [&](auto prefetch, std::uintptr_t address) {
    TransposedTimes<prefetch>(panel, rows, columns, x, y, address);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace emmy
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace emmy {

HWY_EXPORT(TimesFloat);
HWY_EXPORT(TimesDouble);
HWY_EXPORT(TransposedTimesFloat);
HWY_EXPORT(TransposedTimesDouble);

void PanelTimes(const float* panel, int rows, int columns, const float* x,
                float* y, const float* next) {
  HWY_DYNAMIC_DISPATCH(TimesFloat)(panel, rows, columns, x, y, next);
}
void PanelTimes(const double* panel, int rows, int columns, const double* x,
                double* y, const double* next) {
  HWY_DYNAMIC_DISPATCH(TimesDouble)(panel, rows, columns, x, y, next);
}
void TransposedPanelTimes(const float* panel, int rows, int columns,
                          const float* x, float* y, const float* next) {
  HWY_DYNAMIC_DISPATCH(TransposedTimesFloat)(panel, rows, columns, x, y, next);
}
void TransposedPanelTimes(const double* panel, int rows, int columns,
                          const double* x, double* y, const double* next) {
  HWY_DYNAMIC_DISPATCH(TransposedTimesDouble)(panel, rows, columns, x, y, next);
}

}  // namespace emmy
#endif  // HWY_ONCE
