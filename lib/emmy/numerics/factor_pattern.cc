#include "emmy/numerics/factor_pattern.h"

#include <algorithm>

namespace emmy {

FactorPattern FindFactorPattern(const Eigen::SparseMatrix<double>& a) {
  const auto size = static_cast<size_t>(a.cols());
  FactorPattern pattern;
  pattern.starts.reserve(size + 1);
  pattern.starts.push_back(0);
  std::vector<std::vector<int>> children(size);
  std::vector<int> seen(size, -1);  // The last column that has this row.
  for (int column = 0; column < a.cols(); ++column) {
    std::vector<int>& rows = pattern.rows;
    const size_t start = rows.size();
    const auto add = [&](int row) {
      if (row <= column || seen[static_cast<size_t>(row)] == column) return;
      seen[static_cast<size_t>(row)] = column;
      rows.push_back(row);
    };
    for (Eigen::SparseMatrix<double>::InnerIterator it(a, column); it; ++it) {
      add(static_cast<int>(it.row()));
    }
    for (const int child : children[static_cast<size_t>(column)]) {
      const size_t end = pattern.starts[static_cast<size_t>(child) + 1];
      for (size_t k = pattern.starts[static_cast<size_t>(child)]; k < end;
           ++k) {
        add(rows[k]);
      }
    }
    std::sort(rows.begin() + static_cast<std::ptrdiff_t>(start), rows.end());
    pattern.starts.push_back(rows.size());
    if (rows.size() > start) {
      children[static_cast<size_t>(rows[start])].push_back(column);
    }
  }
  return pattern;
}

}  // namespace emmy
