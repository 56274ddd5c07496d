#include "emmy/numerics/supernodal_solve.h"

#include <algorithm>
#include <cstddef>
#include <limits>

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

template <typename Scalar>
void SupernodalSolve<Scalar>::Analyze(const SparseMatrix& lower,
                                      const Permutation& order) {
  FindSupernodes(lower);
  runs_.clear();
  size_t panel_size = 0;
  int most = 0;
  for (Supernode& node : supernodes_) {
    const int last = node.first + node.columns - 1;
    const int begin = lower.outerIndexPtr()[last];
    const int end = lower.outerIndexPtr()[last + 1];
    node.rows = end - begin;
    node.height = Padded<Scalar>(node.columns + node.rows);
    node.panel_start = panel_size;
    node.first_run = runs_.size();
    for (int k = begin; k < end; ++k) {
      const int row = lower.innerIndexPtr()[k];
      if (k > begin && row == lower.innerIndexPtr()[k - 1] + 1) {
        ++runs_.back().count;
      } else {
        runs_.push_back({row, 1});
      }
    }
    node.end_run = runs_.size();
    panel_size +=
        static_cast<size_t>(node.height) * static_cast<size_t>(node.columns);
    most = std::max(most, node.height);
  }
  panels_.assign(panel_size, Scalar(0));
  constexpr size_t kLargeFactor = size_t{8} << 20;  // Bytes.
  fetches_ahead_ = panel_size * sizeof(Scalar) > kLargeFactor;
  place_.assign(static_cast<size_t>(lower.cols()), 0);
  inverse_diagonal_.resize(lower.cols());
  work_.resize(lower.cols());
  gathered_.setZero(most);
  order_ = order.indices();
}

template <typename Scalar>
void SupernodalSolve<Scalar>::UpdatePanel(const SparseMatrix& lower,
                                          const Supernode& node) {
  for (int c = 0; c < node.columns; ++c) {
    place_[static_cast<size_t>(node.first + c)] = c;
  }
  int place = node.columns;
  for (size_t i = node.first_run; i < node.end_run; ++i) {
    for (int r = 0; r < runs_[i].count; ++r) {
      place_[static_cast<size_t>(runs_[i].first + r)] = place++;
    }
  }
  full_panel_.setZero(node.height, node.columns);
  for (int c = 0; c < node.columns; ++c) {
    full_panel_(c, c) = 1.0;
    for (SparseMatrix::InnerIterator it(lower, node.first + c); it; ++it) {
      full_panel_(place_[static_cast<size_t>(it.row())], c) = it.value();
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
  inverse_diagonal_ = diagonal.cwiseInverse().template cast<Scalar>();
  for (const Supernode& node : supernodes_) UpdatePanel(lower, node);
}

template <typename Scalar>
void SupernodalSolve<Scalar>::Solve(const VectorXd& b, VectorXd* x) {
  const Eigen::Index size = b.size();
  // Scaled, so that small residuals stay in the range of Scalar.
  const double largest = b.cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) {
    *x = b;
    return;
  }
  const double scale = std::max(largest, std::numeric_limits<double>::min());
  const double to_unit = 1.0 / scale;
  for (Eigen::Index i = 0; i < size; ++i) {
    work_(order_(i)) = static_cast<Scalar>(b(i) * to_unit);
  }
  Scalar* const gathered = gathered_.data();
  for (size_t n = 0; n < supernodes_.size(); ++n) {
    const Supernode& node = supernodes_[n];
    Scalar* const head = work_.data() + node.first;
    PanelTimes(
        Panel(n), node.height, node.columns, head, gathered,
        fetches_ahead_ && n + 1 < supernodes_.size() ? Panel(n + 1) : nullptr);
    std::copy_n(gathered, node.columns, head);
    const Scalar* update = gathered + node.columns;
    for (size_t i = node.first_run; i < node.end_run; ++i) {
      const auto [first, count] = runs_[i];
      Scalar* const target = work_.data() + first;
      for (int r = 0; r < count; ++r) target[r] -= update[r];
      update += count;
    }
  }
  work_.array() *= inverse_diagonal_.array();
  for (size_t n = supernodes_.size(); n-- > 0;) {
    const Supernode& node = supernodes_[n];
    Scalar* const head = work_.data() + node.first;
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
  x->resize(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    (*x)(i) = scale * static_cast<double>(work_(order_(i)));
  }
}

template class SupernodalSolve<float>;
template class SupernodalSolve<double>;

}  // namespace emmy
