#include "python/history.h"

namespace emmy::python {

History::Columns History::Find(const std::string& name) const {
  for (size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i] == name) return {.first = i, .count = 1};
  }
  for (const std::string axes : {"wxyz", "xyz"}) {
    for (size_t i = 0; i + axes.size() <= columns_.size(); ++i) {
      size_t count = 0;
      while (count < axes.size() &&
             columns_[i + count] == name + "_" + axes[count]) {
        ++count;
      }
      if (count == axes.size()) {
        return {.first = i, .count = count, .is_vector = true};
      }
    }
  }
  return {};
}

}  // namespace emmy::python
