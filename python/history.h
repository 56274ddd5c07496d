// The rows of one run, as a table that NumPy looks at in place.

#ifndef EMMY_PYTHON_HISTORY_H_
#define EMMY_PYTHON_HISTORY_H_

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace emmy::python {

// Grows during the run that makes it and is shown to Python after that only:
// then its memory stays where it is, and arrays may refer to it.
class History {
 public:
  explicit History(std::vector<std::string> columns)
      : columns_(std::move(columns)) {}

  // `row` in the order of HistoryColumns (emmy/io/history.h).
  void Append(const std::vector<double>& row) {
    values_.insert(values_.end(), row.begin(), row.end());
    ++num_rows_;
  }

  const std::vector<std::string>& columns() const { return columns_; }
  size_t num_rows() const { return num_rows_; }
  const double* data() const { return values_.data(); }

  // Columns side by side that one name stands for: the column `name` itself,
  // or those of its components, `name`_x to _z or _w to _z. The count is 0 if
  // there are none.
  struct Columns {
    size_t first = 0;
    size_t count = 0;
    bool is_vector = false;
  };
  Columns Find(const std::string& name) const;

 private:
  std::vector<std::string> columns_;
  std::vector<double> values_;  // Row after row.
  size_t num_rows_ = 0;
};

}  // namespace emmy::python

#endif  // EMMY_PYTHON_HISTORY_H_
