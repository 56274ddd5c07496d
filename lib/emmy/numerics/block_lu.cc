#include "emmy/numerics/block_lu.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <set>

#include "emmy/base/check.h"

namespace emmy {
namespace {

// Finds the order of elimination, and what fills in.
class Elimination {
 public:
  Elimination(int num_blocks, const std::vector<std::pair<int, int>>& pairs,
              const std::vector<std::vector<int>>& waits_for)
      : live_(static_cast<size_t>(num_blocks)),
        waits_(static_cast<size_t>(num_blocks), 0),
        waited_for_(static_cast<size_t>(num_blocks)) {
    for (const auto& [row, column] : pairs) Connect(row, column);
    for (size_t i = 0; i < waits_for.size(); ++i) {
      waits_[i] = waits_for[i].size();
      for (const int other : waits_for[i]) {
        waited_for_[static_cast<size_t>(other)].push_back(static_cast<int>(i));
      }
    }
    for (int i = 0; i < num_blocks; ++i) Enter(i);
  }

  bool done() const { return queue_.empty(); }

  // The next block and its neighbours, which are joined to each other.
  int Next(std::vector<int>* neighbours) {
    const int pivot = queue_.begin()->second;
    queue_.erase(queue_.begin());
    const std::set<int>& live = live_[static_cast<size_t>(pivot)];
    neighbours->assign(live.begin(), live.end());
    for (const int i : *neighbours) Leave(i);
    for (const int i : *neighbours) {
      live_[static_cast<size_t>(i)].erase(pivot);
      for (const int j : *neighbours) Connect(i, j);
    }
    for (const int i : waited_for_[static_cast<size_t>(pivot)]) {
      --waits_[static_cast<size_t>(i)];
    }
    for (const int i : *neighbours) Enter(i);
    return pivot;
  }

 private:
  void Connect(int i, int j) {
    if (i == j) return;
    live_[static_cast<size_t>(i)].insert(j);
    live_[static_cast<size_t>(j)].insert(i);
  }
  std::pair<size_t, int> Key(int i) const {
    return {live_[static_cast<size_t>(i)].size(), i};
  }
  void Enter(int i) {
    if (waits_[static_cast<size_t>(i)] == 0) queue_.insert(Key(i));
  }
  void Leave(int i) { queue_.erase(Key(i)); }

  std::vector<std::set<int>> live_;  // Neighbours not yet eliminated.
  std::vector<size_t> waits_;        // For how many blocks.
  std::vector<std::vector<int>> waited_for_;
  std::set<std::pair<size_t, int>> queue_;  // By degree.
};

}  // namespace

BlockLu::BlockLu(int num_blocks, const std::vector<std::pair<int, int>>& pairs,
                 const std::vector<std::vector<int>>& waits_for)
    : rows_(static_cast<size_t>(num_blocks)) {
  Elimination elimination(num_blocks, pairs, waits_for);
  std::vector<int> neighbours;
  size_t updates = 0;
  while (!elimination.done()) {
    Pivot& pivot = pivots_.emplace_back();
    pivot.block = elimination.Next(&neighbours);
    pivot.first = neighbours_.size();
    pivot.count = neighbours.size();
    pivot.update = updates;
    updates += pivot.count * pivot.count;
    neighbours_.insert(neighbours_.end(), neighbours.begin(), neighbours.end());
    std::vector<int>& row = rows_[static_cast<size_t>(pivot.block)];
    row.push_back(pivot.block);
    for (const int i : neighbours) {
      row.push_back(i);
      rows_[static_cast<size_t>(i)].push_back(pivot.block);
    }
  }
  EMMY_CHECK(pivots_.size() == rows_.size(), "a block waits for none");
  size_t stored = 0;
  for (std::vector<int>& row : rows_) {
    std::sort(row.begin(), row.end());
    row_starts_.push_back(stored);
    stored += row.size();
  }
  blocks_.assign(stored, Matrix3d::Zero());
  inverses_.assign(pivots_.size(), Matrix3d::Zero());
  updates_.reserve(updates);
  for (Pivot& pivot : pivots_) {
    pivot.diagonal = Find(pivot.block, pivot.block);
    for (size_t i = pivot.first; i < pivot.first + pivot.count; ++i) {
      lower_.push_back(Find(neighbours_[i], pivot.block));
      upper_.push_back(Find(pivot.block, neighbours_[i]));
      for (size_t j = pivot.first; j < pivot.first + pivot.count; ++j) {
        updates_.push_back(Find(neighbours_[i], neighbours_[j]));
      }
    }
  }
}

size_t BlockLu::Find(int row, int column) const {
  const std::vector<int>& columns = rows_[static_cast<size_t>(row)];
  const auto place = std::lower_bound(columns.begin(), columns.end(), column);
  EMMY_CHECK(place != columns.end() && *place == column,
             "block (" << row << ", " << column << ") is not in the pattern");
  return row_starts_[static_cast<size_t>(row)] +
         static_cast<size_t>(place - columns.begin());
}

void BlockLu::SetZero() {
  std::fill(blocks_.begin(), blocks_.end(), Matrix3d::Zero());
}

bool BlockLu::Factorize() {
  for (size_t k = 0; k < pivots_.size(); ++k) {
    const Pivot& pivot = pivots_[k];
    inverses_[k] = blocks_[pivot.diagonal].inverse();
    constexpr double kLargestCondition = 0x1p48;  // Five bits would be left.
    const double condition =
        inverses_[k].norm() * blocks_[pivot.diagonal].norm();
    if (!(condition <= kLargestCondition)) return false;
    const size_t* target = updates_.data() + pivot.update;
    for (size_t i = pivot.first; i < pivot.first + pivot.count; ++i) {
      const Matrix3d factor = blocks_[lower_[i]] * inverses_[k];
      blocks_[lower_[i]] = factor;
      for (size_t j = pivot.first; j < pivot.first + pivot.count; ++j) {
        blocks_[*target++].noalias() -= factor * blocks_[upper_[j]];
      }
    }
  }
  return true;
}

void BlockLu::Solve(const VectorXd& b, VectorXd* x) const {
  *x = b;
  const auto part = [x](int block) {
    return x->segment<3>(3 * static_cast<Eigen::Index>(block));
  };
  for (const Pivot& pivot : pivots_) {
    const Vector3d mine = part(pivot.block);
    for (size_t i = pivot.first; i < pivot.first + pivot.count; ++i) {
      part(neighbours_[i]).noalias() -= blocks_[lower_[i]] * mine;
    }
  }
  for (size_t k = pivots_.size(); k-- > 0;) {
    const Pivot& pivot = pivots_[k];
    Vector3d mine = part(pivot.block);
    for (size_t i = pivot.first; i < pivot.first + pivot.count; ++i) {
      mine.noalias() -= blocks_[upper_[i]] * part(neighbours_[i]);
    }
    part(pivot.block).noalias() = inverses_[k] * mine;
  }
}

}  // namespace emmy
