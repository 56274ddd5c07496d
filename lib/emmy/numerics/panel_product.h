// Products of a dense panel P and its transpose with a vector, by SIMD.
//
// For repeated solves with a kept factor, where these products are all the
// time. The instruction set is chosen when the program runs; the bits are the
// same with every one of them: the order of each sum is fixed (over the 64
// bytes of a block first, then in halves), and products are rounded before
// they are added.

#ifndef EMMY_NUMERICS_PANEL_PRODUCT_H_
#define EMMY_NUMERICS_PANEL_PRODUCT_H_

namespace emmy {

// Rows of a panel, and the lengths of the vectors that go with them, are
// padded to a multiple of this many numbers of type Scalar.
template <typename Scalar>
inline constexpr int kPanelRowUnit = 16 / static_cast<int>(sizeof(Scalar));

// y = P x. P is `rows` × `columns`, by columns, without gaps; `rows` is a
// multiple of kPanelRowUnit. No alignment is needed; y must not overlap.
// While P is read, as much is fetched into the cache from `next` on: where the
// panel lies that is wanted after this one. Null: nothing is; where all panels
// stay in the cache, that is faster.
void PanelTimes(const float* panel, int rows, int columns, const float* x,
                float* y, const float* next = nullptr);
void PanelTimes(const double* panel, int rows, int columns, const double* x,
                double* y, const double* next = nullptr);

// y = Pᵀ x, likewise; x has `rows` entries.
void TransposedPanelTimes(const float* panel, int rows, int columns,
                          const float* x, float* y,
                          const float* next = nullptr);
void TransposedPanelTimes(const double* panel, int rows, int columns,
                          const double* x, double* y,
                          const double* next = nullptr);

}  // namespace emmy

#endif  // EMMY_NUMERICS_PANEL_PRODUCT_H_
