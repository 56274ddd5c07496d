#include "emmy/numerics/nested_dissection.h"

#include <cholmod.h>

#include <Eigen/OrderingMethods>
#include <vector>

namespace emmy {
namespace {

constexpr int kBlock = 3;

// Which blocks meet in the lower triangle, compressed by columns.
struct BlockPattern {
  explicit BlockPattern(const Eigen::SparseMatrix<double>& symmetric) {
    const int num_blocks = static_cast<int>(symmetric.cols()) / kBlock;
    begin.push_back(0);
    for (int column = 0; column < num_blocks; ++column) {
      int last = -1;
      for (Eigen::SparseMatrix<double>::InnerIterator it(symmetric,
                                                         kBlock * column);
           it; ++it) {
        const int row = static_cast<int>(it.row()) / kBlock;
        if (row >= column && row != last) rows.push_back(last = row);
      }
      begin.push_back(static_cast<int>(rows.size()));
    }
  }
  std::vector<int> begin, rows;
};

// Order of the blocks; empty if there is none.
std::vector<int> Dissect(BlockPattern pattern) {
  cholmod_common common;
  cholmod_start(&common);
  common.print = 0;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_NESDIS;
  const size_t num_blocks = pattern.begin.size() - 1;
  cholmod_sparse graph = {};
  graph.nrow = num_blocks;
  graph.ncol = num_blocks;
  graph.nzmax = pattern.rows.size();
  graph.p = pattern.begin.data();
  graph.i = pattern.rows.data();
  graph.stype = -1;  // The lower triangle.
  graph.itype = CHOLMOD_INT;
  graph.xtype = CHOLMOD_PATTERN;
  graph.dtype = CHOLMOD_DOUBLE;
  graph.sorted = 1;
  graph.packed = 1;
  std::vector<int> order;
  cholmod_factor* factor = cholmod_analyze(&graph, &common);
  if (factor != nullptr) {
    const int* const first = static_cast<const int*>(factor->Perm);
    order.assign(first, first + num_blocks);
  }
  cholmod_free_factor(&factor, &common);
  cholmod_finish(&common);
  return order;
}

}  // namespace

void NestedDissection::operator()(const Eigen::SparseMatrix<double>& symmetric,
                                  Permutation& order) const {
  const std::vector<int> blocks = Dissect(BlockPattern(symmetric));
  if (blocks.empty()) {
    Eigen::AMDOrdering<int>()(symmetric, order);
    return;
  }
  order.resize(symmetric.cols());
  Eigen::Index place = 0;
  for (const int block : blocks) {
    for (int i = 0; i < kBlock; ++i) {
      order.indices()(place++) = kBlock * block + i;
    }
  }
}

}  // namespace emmy
