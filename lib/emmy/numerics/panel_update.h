// The product by which a panel of a sparse factor updates a later one, by SIMD.
//
// The instruction set is chosen when the program runs; the bits are the same
// with every one of them: sums are taken in the order of the columns, and
// products are rounded before they are added.

#ifndef EMMY_NUMERICS_PANEL_UPDATE_H_
#define EMMY_NUMERICS_PANEL_UPDATE_H_

#include <cstddef>

namespace emmy {

// Rows are treated in blocks of this many: the array of A must be as much
// longer than what it holds.
inline constexpr int kPanelUpdateUnit = 16;

// C = A B: A is `rows` × `inner` by columns, `a_stride` apart; B `inner` ×
// `columns` by rows, without gaps; C by columns, `c_stride` apart, a multiple
// of kPanelUpdateUnit that is at least `rows`. C may have anything in the rows
// beyond.
void PanelUpdate(const double* a, std::ptrdiff_t a_stride, int rows, int inner,
                 const double* b, int columns, double* c,
                 std::ptrdiff_t c_stride);

}  // namespace emmy

#endif  // EMMY_NUMERICS_PANEL_UPDATE_H_
