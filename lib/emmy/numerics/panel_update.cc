// Compiled once for each instruction set: Highway includes this file again
// from foreach_target.h.

#include "emmy/numerics/panel_update.h"

#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "emmy/numerics/panel_update.cc"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
//
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace emmy {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, 8>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));
// As many sums at a time as there are registers for.
constexpr int kVectors = 2;
constexpr int kColumns = 4;
constexpr int kRows = kVectors * kLanes;
static_assert(kPanelUpdateUnit % kRows == 0);

// One block of rows, kCount columns of B and C.
template <int kCount>
HWY_INLINE void Block(const double* HWY_RESTRICT a, ptrdiff_t a_stride,
                      int inner, const double* HWY_RESTRICT b,
                      ptrdiff_t b_stride, double* HWY_RESTRICT c,
                      ptrdiff_t c_stride) {
  const Tag tag;
  hn::Vec<Tag> sum[size_t{kCount}][size_t{kVectors}];
  for (auto& column : sum) {
    for (auto& s : column) s = hn::Zero(tag);
  }
  for (int k = 0; k < inner; ++k) {
    hn::Vec<Tag> left[size_t{kVectors}];
    for (int v = 0; v < kVectors; ++v) left[v] = hn::LoadU(tag, a + v * kLanes);
    for (int j = 0; j < kCount; ++j) {
      const auto right = hn::Set(tag, b[j]);
      for (int v = 0; v < kVectors; ++v) {
        sum[j][v] = hn::Add(sum[j][v], hn::Mul(left[v], right));
      }
    }
    a += a_stride;
    b += b_stride;
  }
  for (int j = 0; j < kCount; ++j) {
    for (int v = 0; v < kVectors; ++v) {
      hn::StoreU(sum[j][v], tag, c + j * c_stride + v * kLanes);
    }
  }
}

void Update(const double* a, ptrdiff_t a_stride, int rows, int inner,
            const double* b, int columns, double* c, ptrdiff_t c_stride) {
  int j = 0;
  const auto columns_of = [&](auto block, int count) {
    for (int row = 0; row < rows; row += kRows) {
      block(a + row, c + j * c_stride + row);
    }
    j += count;
  };
  while (j + kColumns <= columns) {
    columns_of(
        [&](const double* from, double* to) {
          Block<kColumns>(from, a_stride, inner, b + j, columns, to, c_stride);
        },
        kColumns);
  }
  while (j < columns) {
    columns_of(
        [&](const double* from, double* to) {
          Block<1>(from, a_stride, inner, b + j, columns, to, c_stride);
        },
        1);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace emmy
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace emmy {

HWY_EXPORT(Update);

void PanelUpdate(const double* a, std::ptrdiff_t a_stride, int rows, int inner,
                 const double* b, int columns, double* c,
                 std::ptrdiff_t c_stride) {
  HWY_DYNAMIC_DISPATCH(Update)
  (a, a_stride, rows, inner, b, columns, c, c_stride);
}

}  // namespace emmy
#endif  // HWY_ONCE
