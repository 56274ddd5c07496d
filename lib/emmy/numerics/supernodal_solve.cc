#include "emmy/numerics/supernodal_solve.h"

#include <Eigen/OrderingMethods>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <queue>
#include <utility>

#include "emmy/numerics/panel_product.h"
#include "emmy/numerics/panel_update.h"

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

// The lower triangle in the order of elimination.
Eigen::SparseMatrix<double> Permuted(
    const Eigen::SparseMatrix<double>& a,
    const Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>&
        order) {
  Eigen::SparseMatrix<double> permuted(a.rows(), a.cols());
  permuted.selfadjointView<Eigen::Lower>() =
      a.selfadjointView<Eigen::Lower>().twistedBy(order);
  return permuted;
}

// Parts of a large factor; more than processors, so that any number of threads
// has about as much to do.
constexpr size_t kParts = 8;

}  // namespace

// Groups columns while the first row below one is the next column: then all
// rows of the former are rows of the latter, and merging only adds zeros.
template <typename Scalar>
void SupernodalSolve<Scalar>::FindSupernodes(const FactorPattern& lower) {
  constexpr int kWidest = 96;  // Panels beyond this leave the cache.
  supernodes_.clear();
  rows_.clear();
  double zeros = 0.0;  // Of the last supernode.
  for (int column = 0; column < lower.columns(); ++column) {
    const auto count = static_cast<double>(lower.count(column));
    if (column > 0) {
      Supernode& node = supernodes_.back();
      const int before = column - 1;
      const auto count_before = static_cast<double>(lower.count(before));
      const bool connected =
          count_before > 0.0 && *lower.begin(before) == column;
      if (connected && node.columns < kWidest) {
        // Rows of this column which the one before it lacks.
        const double added = count + 1.0 - count_before;
        const double new_zeros = zeros + added * node.columns;
        const double size =
            (node.columns + 1.0) * (0.5 * node.columns + 1.0 + count);
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
  for (Supernode& node : supernodes_) {
    const int last = node.first + node.columns - 1;
    node.rows = static_cast<int>(lower.count(last));
    node.height = Padded<Scalar>(node.columns + node.rows);
    node.first_row = rows_.size();
    rows_.insert(rows_.end(), lower.begin(last), lower.begin(last) + node.rows);
  }
}

// Deals out the branches of a large factor's tree, which reorders supernodes.
// The top is what is left where every branch is small enough for the parts to
// come out alike.
template <typename Scalar>
void SupernodalSolve<Scalar>::DealOutParts() {
  const size_t count = supernodes_.size();
  // Parents have higher numbers than their children.
  const size_t no_parent = count;
  std::vector<size_t> parent(count, no_parent);
  std::vector<std::vector<size_t>> children(count + 1);
  std::vector<size_t> weight(count, 0);
  for (size_t n = 0; n < count; ++n) {
    const Supernode& node = supernodes_[n];
    if (node.rows > 0) {
      parent[n] = supernode_of_[static_cast<size_t>(*Rows(node))];
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
void SupernodalSolve<Scalar>::PlaceUnknowns() {
  const auto size = static_cast<size_t>(order_.size());
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
    const int column = order_.indices()(static_cast<Eigen::Index>(i));
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
void SupernodalSolve<Scalar>::PlacePanels() {
  runs_.clear();
  size_t panel_size = 0;
  for (Supernode& node : supernodes_) {
    node.panel_start = panel_size;
    panel_size += PanelSize(node);
    node.first_run = runs_.size();
    for (int k = 0; k < node.rows; ++k) {
      const int place = place_[static_cast<size_t>(Rows(node)[k])];
      if (k > 0 && place != top_.first_unknown &&
          place == runs_.back().first + runs_.back().count) {
        ++runs_.back().count;
      } else {
        runs_.push_back({place, 1});
      }
    }
    node.end_run = runs_.size();
  }
  panels_.assign(panel_size, Scalar(0));
  // PanelUpdate reads beyond the rows.
  factor_.assign(panel_size + kPanelUpdateUnit, 0.0);
}

template <typename Scalar>
void SupernodalSolve<Scalar>::Analyze(const SparseMatrix& a,
                                      size_t large_factor) {
  const SparseMatrix full = a.template selfadjointView<Eigen::Lower>();
  Permutation unknown_of_row;
  Eigen::AMDOrdering<int>()(full, unknown_of_row);
  order_ = unknown_of_row.inverse();
  FindSupernodes(FindFactorPattern(Permuted(a, order_)));

  size_t panel_size = 0;
  int most = 0;
  for (const Supernode& node : supernodes_) {
    panel_size += PanelSize(node);
    most = std::max(most, node.height);
  }
  const auto number_supernodes = [this, &a] {
    supernode_of_.resize(static_cast<size_t>(a.cols()));
    for (size_t n = 0; n < supernodes_.size(); ++n) {
      std::fill_n(supernode_of_.begin() + supernodes_[n].first,
                  supernodes_[n].columns, n);
    }
  };
  number_supernodes();
  fetches_ahead_ = panel_size * sizeof(Scalar) > large_factor;
  parts_.clear();
  top_.first = 0;
  top_.end = supernodes_.size();
  if (fetches_ahead_) {
    DealOutParts();
    number_supernodes();
  }
  PlaceUnknowns();
  PlacePanels();
  row_in_panel_.assign(static_cast<size_t>(a.cols()), 0);
  inverse_diagonal_.resize(a.cols());
  work_.resize(a.cols());
  for (Part& part : parts_) {
    part.top.setZero(top_.end_unknown - top_.first_unknown);
    part.gathered.setZero(most);
  }
  top_.gathered.setZero(most);
}

// The columns of the matrix, and where each row is in the panel.
template <typename Scalar>
void SupernodalSolve<Scalar>::FormPanel(const SparseMatrix& permuted,
                                        const Supernode& node) {
  for (int c = 0; c < node.columns; ++c) {
    row_in_panel_[static_cast<size_t>(node.first + c)] = c;
  }
  for (int r = 0; r < node.rows; ++r) {
    row_in_panel_[static_cast<size_t>(Rows(node)[r])] = node.columns + r;
  }
  double* column = FactorPanel(node);
  std::fill_n(column, PanelSize(node), 0.0);
  for (int c = 0; c < node.columns; ++c, column += node.height) {
    for (SparseMatrix::InnerIterator it(permuted, node.first + c); it; ++it) {
      column[row_in_panel_[static_cast<size_t>(it.row())]] = it.value();
    }
  }
}

// product_ = L₂ D L₁ᵀ, by columns: L₂ is `num_rows` rows of the first `inner`
// columns of a panel from `first_row` on, L₁ the first `num_columns` of them.
// Returns the length of a column.
template <typename Scalar>
std::ptrdiff_t SupernodalSolve<Scalar>::Multiply(const Supernode& node,
                                                 int inner, int first_row,
                                                 int num_rows,
                                                 int num_columns) {
  const double* const panel = FactorPanel(node);
  scaled_.resize(static_cast<size_t>(inner * num_columns));
  double* scaled = scaled_.data();
  for (int k = 0; k < inner; ++k) {
    const std::ptrdiff_t column = std::ptrdiff_t{k} * node.height;
    const double pivot = panel[column + k];
    for (int j = 0; j < num_columns; ++j) {
      *scaled++ = pivot * panel[column + first_row + j];
    }
  }
  constexpr int kUnit = kPanelUpdateUnit;
  const std::ptrdiff_t stride = (num_rows + kUnit - 1) / kUnit * kUnit;
  product_.resize(static_cast<size_t>(stride * num_columns));
  PanelUpdate(panel + first_row, node.height, num_rows, inner, scaled_.data(),
              num_columns, product_.data(), stride);
  return stride;
}

// What an earlier panel gives to this one; its rows there are done with.
template <typename Scalar>
void SupernodalSolve<Scalar>::Subtract(Supernode* from, const Supernode& node) {
  const int* const rows = Rows(*from) + from->first_common;
  const int num_rows = from->rows - from->first_common;
  const int end = node.first + node.columns;
  int num_columns = 0;
  while (num_columns < num_rows && rows[num_columns] < end) ++num_columns;
  const std::ptrdiff_t stride =
      Multiply(*from, from->columns, from->columns + from->first_common,
               num_rows, num_columns);
  for (int j = 0; j < num_columns; ++j) {
    double* const column =
        FactorPanel(node) + std::ptrdiff_t{rows[j] - node.first} * node.height;
    const double* const product = product_.data() + j * stride;
    for (int i = j; i < num_rows; ++i) {
      column[row_in_panel_[static_cast<size_t>(rows[i])]] -= product[i];
    }
  }
  from->first_common += num_columns;
}

// L of one panel, and D on its diagonal.
template <typename Scalar>
bool SupernodalSolve<Scalar>::FactorizePanel(const Supernode& node) {
  constexpr int kBlock = 8;  // Columns of one PanelUpdate.
  double* const panel = FactorPanel(node);
  const std::ptrdiff_t height = node.height;
  for (int first = 0; first < node.columns; first += kBlock) {
    const int count = std::min(kBlock, node.columns - first);
    const int num_rows = node.height - first;
    if (first > 0) {
      const std::ptrdiff_t stride =
          Multiply(node, first, first, num_rows, count);
      for (int j = 0; j < count; ++j) {
        double* const column = panel + (first + j) * height + first;
        const double* const product = product_.data() + j * stride;
        for (int i = j; i < num_rows; ++i) column[i] -= product[i];
      }
    }
    for (int c = first; c < first + count; ++c) {
      double* const column = panel + c * height;
      for (int k = first; k < c; ++k) {
        const double* const before = panel + k * height;
        const double factor = before[k] * before[c];
        for (int i = c; i < node.height; ++i) column[i] -= factor * before[i];
      }
      const double pivot = column[c];
      if (pivot == 0.0 || !std::isfinite(pivot)) return false;
      const double inverse = 1.0 / pivot;
      for (int i = c + 1; i < node.height; ++i) column[i] *= inverse;
    }
  }
  return true;
}

template <typename Scalar>
void SupernodalSolve<Scalar>::InvertPanel(const Supernode& node) {
  const Eigen::Map<const MatrixXd> factor(FactorPanel(node), node.height,
                                          node.columns);
  inverse_diagonal_.segment(node.place, node.columns) =
      factor.diagonal().cwiseInverse().template cast<Scalar>();
  const MatrixXd inverse =
      factor.topRows(node.columns)
          .template triangularView<Eigen::UnitLower>()
          .solve(MatrixXd::Identity(node.columns, node.columns));
  Eigen::Map<Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>> panel(
      panels_.data() + node.panel_start, node.height, node.columns);
  panel.topRows(node.columns) = inverse.template cast<Scalar>();
  panel.middleRows(node.columns, node.rows) =
      (factor.middleRows(node.columns, node.rows) * inverse)
          .template cast<Scalar>();
}

// For the panel that has the first of the rows which are left.
template <typename Scalar>
void SupernodalSolve<Scalar>::Wait(size_t supernode) {
  Supernode& node = supernodes_[supernode];
  if (node.first_common == node.rows) return;
  const size_t panel =
      supernode_of_[static_cast<size_t>(Rows(node)[node.first_common])];
  node.next_waiting = first_waiting_[panel];
  first_waiting_[panel] = supernode;
}

template <typename Scalar>
bool SupernodalSolve<Scalar>::Factorize(const SparseMatrix& a) {
  const SparseMatrix permuted = Permuted(a, order_);
  const size_t count = supernodes_.size();
  first_waiting_.assign(count, count);
  for (size_t n = 0; n < count; ++n) {
    Supernode& node = supernodes_[n];
    FormPanel(permuted, node);
    for (size_t from = first_waiting_[n]; from < count;) {
      Supernode& earlier = supernodes_[from];
      const size_t next = earlier.next_waiting;
      Subtract(&earlier, node);
      Wait(from);
      from = next;
    }
    if (!FactorizePanel(node)) return false;
    InvertPanel(node);
    node.first_common = 0;
    Wait(n);
  }
  return true;
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
