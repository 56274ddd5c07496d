// The space that sparse rows span, by Gaussian elimination row by row.

#ifndef EMMY_MODEL_ROW_SPACE_H_
#define EMMY_MODEL_ROW_SPACE_H_

#include <cstddef>
#include <map>
#include <unordered_map>
#include <vector>

namespace emmy {

using SparseRow = std::map<int, double>;  // By column.

double LargestEntry(const SparseRow& row);

class RowSpace {
 public:
  // How many rows will have an entry in `column`: among the columns that may
  // serve as a pivot the one in the fewest rows does, so that a chain fills in
  // nothing.
  void CountUse(int column) { ++uses_[column]; }

  // What is left of `row` when the rows of the space are taken out of it.
  SparseRow Reduce(SparseRow row) const;

  // Takes in a row that Reduce returned, not zero; threshold pivoting.
  void Add(SparseRow reduced);

 private:
  int SparsestColumn(const SparseRow& row, double least) const;

  std::vector<SparseRow> pivot_rows_;             // Scaled to pivot 1.
  std::unordered_map<int, size_t> row_of_pivot_;  // By column.
  std::unordered_map<int, int> uses_;             // Rows by column.
};

}  // namespace emmy

#endif  // EMMY_MODEL_ROW_SPACE_H_
