// Elimination order of large nets: nested dissection.
//
// The order cuts the graph of a matrix in two along few unknowns, which come
// last, and each half again (George, SIAM J. Numer. Anal. 10 (1973)). Against
// the minimum degree it leaves less fill-in in large plane nets, and halves
// that can be solved at the same time.

#ifndef EMMY_NUMERICS_NESTED_DISSECTION_H_
#define EMMY_NUMERICS_NESTED_DISSECTION_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace emmy {

// For use where Eigen asks for an ordering.
class NestedDissection {
 public:
  using Permutation =
      Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;

  // `symmetric` has both triangles and consists of 3×3 blocks, which stay
  // together. Entry k of `order` is the unknown that is eliminated as the k-th.
  // Without CHOLMOD's partitioning: the minimum degree.
  void operator()(const Eigen::SparseMatrix<double>& symmetric,
                  Permutation& order) const;
};

}  // namespace emmy

#endif  // EMMY_NUMERICS_NESTED_DISSECTION_H_
