// Which numbers of a sparse factor L of a symmetric matrix are not zero.

#ifndef EMMY_NUMERICS_FACTOR_PATTERN_H_
#define EMMY_NUMERICS_FACTOR_PATTERN_H_

#include <Eigen/SparseCore>
#include <cstddef>
#include <vector>

namespace emmy {

// Rows below the diagonal of each column, ascending; those of column c are
// rows[starts[c]] to rows[starts[c + 1]], the latter excluded.
struct FactorPattern {
  std::vector<size_t> starts;
  std::vector<int> rows;

  int columns() const { return static_cast<int>(starts.size()) - 1; }
  size_t count(int column) const {
    const auto c = static_cast<size_t>(column);
    return starts[c + 1] - starts[c];
  }
  const int* begin(int column) const {
    return rows.data() + starts[static_cast<size_t>(column)];
  }
};

// Of the factor of the matrix whose lower triangle is `a`, in the order of its
// columns: a column has what `a` has there, and every row of a column whose
// first row it is.
FactorPattern FindFactorPattern(const Eigen::SparseMatrix<double>& a);

}  // namespace emmy

#endif  // EMMY_NUMERICS_FACTOR_PATTERN_H_
