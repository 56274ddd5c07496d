// Disjoint sets of the numbers 0, …, n − 1, which can be joined.
//
// Each set has one of its numbers to stand for it. The caller says which when
// two are joined, so that results do not depend on the heights of trees;
// finding it halves the way there, which keeps the mean cost of it at O(log n).

#ifndef EMMY_BASE_DISJOINT_SETS_H_
#define EMMY_BASE_DISJOINT_SETS_H_

#include <cstddef>
#include <numeric>
#include <vector>

namespace emmy {

class DisjointSets {
 public:
  // Every number a set by itself.
  explicit DisjointSets(size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), size_t{0});
  }

  size_t size() const { return parent_.size(); }

  // The number that stands for the set of `i`. Not by two threads at once.
  size_t Find(size_t i) const {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }

  // What stands for the set of `kept` stands for that of `joined` as well.
  void Join(size_t kept, size_t joined) { parent_[Find(joined)] = Find(kept); }

 private:
  mutable std::vector<size_t> parent_;  // Find shortens ways, not results.
};

}  // namespace emmy

#endif  // EMMY_BASE_DISJOINT_SETS_H_
