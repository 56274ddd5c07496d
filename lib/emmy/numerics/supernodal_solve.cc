#include "emmy/numerics/supernodal_solve.h"

#include <algorithm>
#include <cstddef>

namespace emmy {
namespace {

// Whether the pattern of `next` is that of the column before it, less its
// first row, which is `next` itself.
bool Continues(const Eigen::SparseMatrix<double>& lower, int next) {
  const int* outer = lower.outerIndexPtr();
  const int* inner = lower.innerIndexPtr();
  const int size = outer[next + 1] - outer[next];
  const int before = outer[next - 1];
  return outer[next] - before == size + 1 && inner[before] == next &&
         std::equal(inner + before + 1, inner + outer[next],
                    inner + outer[next]);
}

}  // namespace

template <typename Scalar>
void SupernodalSolve<Scalar>::Analyze(const SparseMatrix& lower,
                                      const Permutation& order) {
  const int size = static_cast<int>(lower.cols());
  supernodes_.clear();
  rows_.clear();
  size_t panel_size = 0;
  int most_rows = 0;
  for (int column = 0; column < size; ++column) {
    constexpr int kWidest = 96;  // Panels beyond this leave the cache.
    if (column > 0 && supernodes_.back().columns < kWidest &&
        Continues(lower, column)) {
      ++supernodes_.back().columns;
      continue;
    }
    Supernode& supernode = supernodes_.emplace_back();
    supernode.first = column;
    supernode.columns = 1;
  }
  for (Supernode& supernode : supernodes_) {
    const int last = supernode.first + supernode.columns - 1;
    const int begin = lower.outerIndexPtr()[last];
    const int end = lower.outerIndexPtr()[last + 1];
    supernode.rows = end - begin;
    supernode.row_start = rows_.size();
    supernode.panel_start = panel_size;
    rows_.insert(rows_.end(), lower.innerIndexPtr() + begin,
                 lower.innerIndexPtr() + end);
    panel_size += static_cast<size_t>(supernode.columns + supernode.rows) *
                  static_cast<size_t>(supernode.columns);
    most_rows = std::max(most_rows, supernode.rows);
  }
  panels_.assign(panel_size, Scalar(0));
  inverse_diagonal_.resize(size);
  work_.resize(size);
  gathered_.resize(most_rows);
  order_ = order.indices();
}

template <typename Scalar>
void SupernodalSolve<Scalar>::Update(const SparseMatrix& lower,
                                     const VectorXd& diagonal) {
  inverse_diagonal_ = diagonal.cwiseInverse().template cast<Scalar>();
  for (const Supernode& supernode : supernodes_) {
    const int height = supernode.columns + supernode.rows;
    for (int c = 0; c < supernode.columns; ++c) {
      const int column = supernode.first + c;
      // The column holds the rows below its diagonal, in this order.
      const double* values = lower.valuePtr() + lower.outerIndexPtr()[column];
      Scalar* panel = panels_.data() + supernode.panel_start +
                      static_cast<ptrdiff_t>(c) * height;
      for (int r = c + 1; r < height; ++r) {
        panel[r] = static_cast<Scalar>(*values++);
      }
    }
  }
}

template <typename Scalar>
void SupernodalSolve<Scalar>::Solve(const VectorXd& b, VectorXd* x) {
  using Panel =
      Eigen::Map<const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>>;
  const Eigen::Index size = b.size();
  // Scaled, so that small residuals stay in the range of Scalar.
  const double scale = b.cwiseAbs().maxCoeff();
  if (!(scale > 0.0)) {
    *x = b;
    return;
  }
  for (Eigen::Index i = 0; i < size; ++i) {
    work_(order_(i)) = static_cast<Scalar>(b(i) / scale);
  }
  for (const Supernode& node : supernodes_) {
    const Panel panel(panels_.data() + node.panel_start,
                      node.columns + node.rows, node.columns);
    auto head = work_.segment(node.first, node.columns);
    panel.topRows(node.columns)
        .template triangularView<Eigen::UnitLower>()
        .solveInPlace(head);
    if (node.rows == 0) continue;
    auto update = gathered_.head(node.rows);
    update.noalias() = panel.bottomRows(node.rows) * head;
    const int* rows = rows_.data() + node.row_start;
    for (int r = 0; r < node.rows; ++r) work_(rows[r]) -= update(r);
  }
  work_.array() *= inverse_diagonal_.array();
  for (auto it = supernodes_.rbegin(); it != supernodes_.rend(); ++it) {
    const Supernode& node = *it;
    const Panel panel(panels_.data() + node.panel_start,
                      node.columns + node.rows, node.columns);
    auto head = work_.segment(node.first, node.columns);
    const int* rows = rows_.data() + node.row_start;
    auto below = gathered_.head(node.rows);
    for (int r = 0; r < node.rows; ++r) below(r) = work_(rows[r]);
    head.noalias() -= panel.bottomRows(node.rows).transpose() * below;
    panel.topRows(node.columns)
        .template triangularView<Eigen::UnitLower>()
        .transpose()
        .solveInPlace(head);
  }
  x->resize(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    (*x)(i) = scale * static_cast<double>(work_(order_(i)));
  }
}

template class SupernodalSolve<float>;
template class SupernodalSolve<double>;

}  // namespace emmy
