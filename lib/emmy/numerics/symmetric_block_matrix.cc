#include "emmy/numerics/symmetric_block_matrix.h"

#include <algorithm>

#include "emmy/base/check.h"

namespace emmy {

SymmetricBlockMatrix::SymmetricBlockMatrix(
    int num_blocks, const std::vector<std::pair<int, int>>& pairs)
    : num_blocks_(num_blocks), rows_(static_cast<size_t>(num_blocks)) {
  for (const auto& [row, column] : pairs) {
    rows_[static_cast<size_t>(std::min(row, column))].push_back(
        std::max(row, column));
  }
  int num_entries = 0;
  for (std::vector<int>& rows : rows_) {
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    num_entries += 9 * static_cast<int>(rows.size());
  }
  matrix_.resize(3 * num_blocks, 3 * num_blocks);
  matrix_.resizeNonZeros(num_entries);
  int next = 0;
  for (int block = 0; block < num_blocks; ++block) {
    for (int c = 0; c < 3; ++c) {
      matrix_.outerIndexPtr()[3 * block + c] = next;
      for (const int row : rows_[static_cast<size_t>(block)]) {
        for (int r = 0; r < 3; ++r) {
          matrix_.innerIndexPtr()[next++] = 3 * row + r;
        }
      }
    }
  }
  matrix_.outerIndexPtr()[3 * num_blocks] = next;
  SetZero();
}

SymmetricBlockMatrix::Slot SymmetricBlockMatrix::Find(int row,
                                                      int column) const {
  const std::vector<int>& rows = rows_[static_cast<size_t>(column)];
  const auto place = std::lower_bound(rows.begin(), rows.end(), row);
  EMMY_CHECK(place != rows.end() && *place == row,
             "block (" << row << ", " << column << ") is not in the pattern");
  return {column, static_cast<int>(place - rows.begin())};
}

void SymmetricBlockMatrix::SetZero() {
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
}

void SymmetricBlockMatrix::SetValues(const VectorXd& values) {
  EMMY_CHECK(values.size() == matrix_.nonZeros(), values.size());
  std::copy(values.begin(), values.end(), matrix_.valuePtr());
}

void SymmetricBlockMatrix::Add(const Slot& slot, const Matrix3d& block) {
  for (int c = 0; c < 3; ++c) {
    double* values = matrix_.valuePtr() +
                     matrix_.outerIndexPtr()[3 * slot.block_column + c] +
                     3 * slot.position;
    for (int r = 0; r < 3; ++r) values[r] += block(r, c);
  }
}

}  // namespace emmy
