#include "emmy/numerics/supernodal_solve.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <queue>
#include <utility>

#include "emmy/numerics/panel_product.h"

namespace emmy {
namespace {

// Whether merging is worth it: `zeros` of `size` numbers are stored for
// nothing, but wider panels have fewer sums to scatter.
bool PaysToMerge(int columns, double zeros, double size) {
  constexpr int kNarrow = 12;  // Four nodes.
  constexpr int kWide = 48;
  constexpr double kManyZeros = 0.4;
  constexpr double kFewZeros = 0.1;
  if (columns <= kNarrow) return zeros < kManyZeros * size;
  return columns <= kWide && zeros < kFewZeros * size;
}

template <typename Scalar>
int Padded(int rows) {
  constexpr int kUnit = kPanelRowUnit<Scalar>;
  return (rows + kUnit - 1) / kUnit * kUnit;
}

// Parts of a large factor; more than processors, so that any number of threads
// has about as much to do.
constexpr size_t kParts = 8;

}  // namespace

// Groups columns while the first row below one is the next column: then all
// rows of the former are rows of the latter, and merging only adds zeros.
template <typename Scalar>
void SupernodalSolve<Scalar>::FindSupernodes(const SparseMatrix& lower) {
  const int* outer = lower.outerIndexPtr();
  const int* inner = lower.innerIndexPtr();
  const auto count = [outer](int column) {
    return outer[column + 1] - outer[column];
  };
  constexpr int kWidest = 96;  // Panels beyond this leave the cache.
  supernodes_.clear();
  double zeros = 0.0;  // Of the last supernode.
  for (int column = 0; column < lower.cols(); ++column) {
    if (column > 0) {
      Supernode& node = supernodes_.back();
      const int before = column - 1;
      const bool connected =
          count(before) > 0 && inner[outer[before]] == column;
      if (connected && node.columns < kWidest) {
        // Rows of this column which the one before it lacks.
        const double added = count(column) + 1 - count(before);
        const double new_zeros = zeros + added * node.columns;
        const double size =
            (node.columns + 1.0) * (0.5 * node.columns + 1.0 + count(column));
        if (added == 0.0 || PaysToMerge(node.columns + 1, new_zeros, size)) {
          ++node.columns;
          zeros = new_zeros;
          continue;
        }
      }
    }
    Supernode& node = supernodes_.emplace_back();
    node.first = column;
    node.columns = 1;
    zeros = 0.0;
  }
}

// Deals out the branches of a large factor's tree, which reorders supernodes.
// The top is what is left where every branch is small enough for the parts to
// come out alike.
template <typename Scalar>
void SupernodalSolve<Scalar>::DealOutParts(const SparseMatrix& lower) {
  const size_t count = supernodes_.size();
  std::vector<size_t> node_of(static_cast<size_t>(lower.cols()));
  for (size_t n = 0; n < count; ++n) {
    const Supernode& node = supernodes_[n];
    std::fill_n(node_of.begin() + node.first, node.columns, n);
  }
  // Parents have higher numbers than their children.
  const size_t no_parent = count;
  std::vector<size_t> parent(count, no_parent);
  std::vector<std::vector<size_t>> children(count + 1);
  std::vector<size_t> weight(count, 0);
  for (size_t n = 0; n < count; ++n) {
    const Supernode& node = supernodes_[n];
    if (node.rows > 0) {
      const int* const rows = lower.innerIndexPtr() +
                              lower.outerIndexPtr()[node.first + node.columns] -
                              node.rows;
      parent[n] = node_of[static_cast<size_t>(rows[0])];
    }
    weight[n] += PanelSize(node);
    if (parent[n] != no_parent) weight[parent[n]] += weight[n];
    children[parent[n]].push_back(n);
  }
  size_t total = 0;
  std::priority_queue<std::pair<size_t, size_t>> branches;  // Heaviest first.
  const auto add_branches = [&](const std::vector<size_t>& roots) {
    for (const size_t root : roots) branches.emplace(weight[root], root);
  };
  for (const size_t root : children[no_parent]) total += weight[root];
  add_branches(children[no_parent]);
  const size_t no_part = kParts;
  std::vector<size_t> part_of(count, no_part);
  while (!branches.empty() && branches.top().first > total / kParts) {
    const size_t root = branches.top().second;
    branches.pop();
    add_branches(children[root]);
  }
  // Each to the part that has least so far.
  std::array<size_t, kParts> load{};
  for (; !branches.empty(); branches.pop()) {
    const auto [branch_weight, root] = branches.top();
    const auto lightest = std::min_element(load.begin(), load.end());
    *lightest += branch_weight;
    part_of[root] = static_cast<size_t>(lightest - load.begin());
  }
  for (size_t n = count; n-- > 0;) {
    if (part_of[n] == no_part && parent[n] != no_parent) {
      part_of[n] = part_of[parent[n]];
    }
  }
  std::vector<Supernode> in_order;
  in_order.reserve(count);
  for (size_t p = 0; p <= kParts; ++p) {
    Part& part = p < kParts ? parts_.emplace_back() : top_;
    part.first = in_order.size();
    for (size_t n = 0; n < count; ++n) {
      if (part_of[n] == p) in_order.push_back(supernodes_[n]);
    }
    part.end = in_order.size();
  }
  supernodes_ = std::move(in_order);
}

template <typename Scalar>
void SupernodalSolve<Scalar>::PlaceUnknowns(const Permutation& order) {
  const auto size = static_cast<size_t>(order.size());
  place_.assign(size, 0);
  int place = 0;
  for (Supernode& node : supernodes_) {
    node.place = place;
    for (int c = 0; c < node.columns; ++c) {
      place_[static_cast<size_t>(node.first + c)] = place++;
    }
  }
  unknown_.assign(size, 0);
  for (size_t i = 0; i < size; ++i) {
    const int column = order.indices()(static_cast<Eigen::Index>(i));
    unknown_[static_cast<size_t>(place_[static_cast<size_t>(column)])] =
        static_cast<int>(i);
  }
  const auto place_of = [this, place](size_t supernode) {
    return supernode < supernodes_.size() ? supernodes_[supernode].place
                                          : place;
  };
  const auto limit = [&place_of](Part* part) {
    part->first_unknown = place_of(part->first);
    part->end_unknown = place_of(part->end);
  };
  for (Part& part : parts_) limit(&part);
  limit(&top_);
}

template <typename Scalar>
void SupernodalSolve<Scalar>::PlacePanels(const SparseMatrix& lower) {
  runs_.clear();
  size_t panel_size = 0;
  for (Supernode& node : supernodes_) {
    node.panel_start = panel_size;
    panel_size += PanelSize(node);
    node.first_run = runs_.size();
    const int end = lower.outerIndexPtr()[node.first + node.columns];
    for (int k = end - node.rows; k < end; ++k) {
      const int row = lower.innerIndexPtr()[k];
      const int place = place_[static_cast<size_t>(row)];
      if (k > end - node.rows && place != top_.first_unknown &&
          place == runs_.back().first + runs_.back().count) {
        ++runs_.back().count;
      } else {
        runs_.push_back({place, 1});
      }
    }
    node.end_run = runs_.size();
  }
  panels_.assign(panel_size, Scalar(0));
}

template <typename Scalar>
void SupernodalSolve<Scalar>::Analyze(const SparseMatrix& lower,
                                      const Permutation& order,
                                      size_t large_factor) {
  FindSupernodes(lower);
  size_t panel_size = 0;
  int most = 0;
  for (Supernode& node : supernodes_) {
    const int last = node.first + node.columns - 1;
    node.rows = lower.outerIndexPtr()[last + 1] - lower.outerIndexPtr()[last];
    node.height = Padded<Scalar>(node.columns + node.rows);
    panel_size += PanelSize(node);
    most = std::max(most, node.height);
  }
  fetches_ahead_ = panel_size * sizeof(Scalar) > large_factor;
  parts_.clear();
  top_.first = 0;
  top_.end = supernodes_.size();
  if (fetches_ahead_) DealOutParts(lower);
  PlaceUnknowns(order);
  PlacePanels(lower);
  row_in_panel_.assign(static_cast<size_t>(lower.cols()), 0);
  inverse_diagonal_.resize(lower.cols());
  work_.resize(lower.cols());
  for (Part& part : parts_) {
    part.top.setZero(top_.end_unknown - top_.first_unknown);
    part.gathered.setZero(most);
  }
  top_.gathered.setZero(most);
}

template <typename Scalar>
void SupernodalSolve<Scalar>::UpdatePanel(const SparseMatrix& lower,
                                          const Supernode& node) {
  const int* const rows = lower.innerIndexPtr() +
                          lower.outerIndexPtr()[node.first + node.columns] -
                          node.rows;
  for (int c = 0; c < node.columns; ++c) {
    row_in_panel_[static_cast<size_t>(node.first + c)] = c;
  }
  for (int r = 0; r < node.rows; ++r) {
    row_in_panel_[static_cast<size_t>(rows[r])] = node.columns + r;
  }
  full_panel_.setZero(node.height, node.columns);
  for (int c = 0; c < node.columns; ++c) {
    full_panel_(c, c) = 1.0;
    for (SparseMatrix::InnerIterator it(lower, node.first + c); it; ++it) {
      full_panel_(row_in_panel_[static_cast<size_t>(it.row())], c) = it.value();
    }
  }
  const MatrixXd inverse =
      full_panel_.topRows(node.columns)
          .template triangularView<Eigen::UnitLower>()
          .solve(MatrixXd::Identity(node.columns, node.columns));
  Eigen::Map<Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>> panel(
      panels_.data() + node.panel_start, node.height, node.columns);
  panel.topRows(node.columns) = inverse.template cast<Scalar>();
  panel.middleRows(node.columns, node.rows) =
      (full_panel_.middleRows(node.columns, node.rows) * inverse)
          .template cast<Scalar>();
}

template <typename Scalar>
void SupernodalSolve<Scalar>::Update(const SparseMatrix& lower,
                                     const VectorXd& diagonal) {
  for (const Supernode& node : supernodes_) {
    inverse_diagonal_.segment(node.place, node.columns) =
        diagonal.segment(node.first, node.columns)
            .cwiseInverse()
            .template cast<Scalar>();
    UpdatePanel(lower, node);
  }
}

// y = L⁻¹ b, then D⁻¹ y, of one part's unknowns.
template <typename Scalar>
void SupernodalSolve<Scalar>::Forward(const VectorXd& b, double to_unit,
                                      Part* part) {
  for (int k = part->first_unknown; k < part->end_unknown; ++k) {
    work_(k) =
        static_cast<Scalar>(b(unknown_[static_cast<size_t>(k)]) * to_unit);
  }
  const bool is_top = part == &top_;
  if (is_top) {
    for (const Part& branch : parts_) {
      work_.tail(branch.top.size()) += branch.top;
    }
  }
  part->top.setZero();
  const int top_first = top_.first_unknown;
  Scalar* const top = is_top ? work_.data() + top_first : part->top.data();
  Scalar* const gathered = part->gathered.data();
  for (size_t n = part->first; n < part->end; ++n) {
    const Supernode& node = supernodes_[n];
    Scalar* const head = work_.data() + node.place;
    PanelTimes(
        Panel(n), node.height, node.columns, head, gathered,
        fetches_ahead_ && n + 1 < supernodes_.size() ? Panel(n + 1) : nullptr);
    std::copy_n(gathered, node.columns, head);
    const Scalar* update = gathered + node.columns;
    for (size_t i = node.first_run; i < node.end_run; ++i) {
      const auto [first, count] = runs_[i];
      Scalar* const target =
          first < top_first ? work_.data() + first : top + (first - top_first);
      for (int r = 0; r < count; ++r) target[r] -= update[r];
      update += count;
    }
  }
  const int count = part->end_unknown - part->first_unknown;
  work_.segment(part->first_unknown, count).array() *=
      inverse_diagonal_.segment(part->first_unknown, count).array();
}

// x = L⁻ᵀ y of one part's unknowns; the top's are known.
template <typename Scalar>
void SupernodalSolve<Scalar>::Backward(double scale, Part* part, VectorXd* x) {
  Scalar* const gathered = part->gathered.data();
  for (size_t n = part->end; n-- > part->first;) {
    const Supernode& node = supernodes_[n];
    Scalar* const head = work_.data() + node.place;
    std::copy_n(head, node.columns, gathered);
    Scalar* below = gathered + node.columns;
    for (size_t i = node.first_run; i < node.end_run; ++i) {
      const auto [first, count] = runs_[i];
      const Scalar* const source = work_.data() + first;
      for (int r = 0; r < count; ++r) below[r] = -source[r];
      below += count;
    }
    // What is left from other panels must not meet the padding's zeros.
    std::fill(below, gathered + node.height, Scalar(0));
    TransposedPanelTimes(Panel(n), node.height, node.columns, gathered, head,
                         fetches_ahead_ && n > 0 ? Panel(n - 1) : nullptr);
  }
  for (int k = part->first_unknown; k < part->end_unknown; ++k) {
    (*x)(unknown_[static_cast<size_t>(k)]) =
        scale * static_cast<double>(work_(k));
  }
}

template <typename Scalar>
void SupernodalSolve<Scalar>::Solve(const VectorXd& b, VectorXd* x,
                                    WorkTeam* team) {
  // Scaled, so that small residuals stay in the range of Scalar.
  const double largest = b.cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) {
    *x = b;
    return;
  }
  const double scale = std::max(largest, std::numeric_limits<double>::min());
  const double to_unit = 1.0 / scale;
  x->resize(b.size());
  const auto each_part = [&](const auto& work) {
    const auto range = [&](size_t /*member*/, size_t first, size_t last) {
      for (size_t p = first; p < last; ++p) work(&parts_[p]);
    };
    if (team != nullptr && !parts_.empty()) {
      team->Run(parts_.size(), range);
    } else {
      range(0, 0, parts_.size());
    }
  };
  each_part([&](Part* part) { Forward(b, to_unit, part); });
  Forward(b, to_unit, &top_);
  Backward(scale, &top_, x);
  each_part([&](Part* part) { Backward(scale, part, x); });
}

template class SupernodalSolve<float>;
template class SupernodalSolve<double>;

}  // namespace emmy
