// Fixed-size vectors and matrices used throughout the library.
//
// Eigen chooses by the compiler's flags where it puts such a vector in a struct
// and how it takes and frees memory. A program that chose otherwise than the
// library would read other numbers than were written and free what it did not
// allocate: -mavx, -mavx2 and -march=native do that, and so does g++'s
// -fsanitize=address. It does not compile instead.

#ifndef EMMY_BASE_TYPES_H_
#define EMMY_BASE_TYPES_H_

#include <Eigen/Core>

// How the library was built; other values come with its package for CMake and
// with emmy.pc.
#ifndef EMMY_EIGEN_ALIGN_BYTES
// Alignment of memory that Eigen takes [bytes].
#define EMMY_EIGEN_ALIGN_BYTES 16
#endif
#ifndef EMMY_EIGEN_STATIC_ALIGN_BYTES
// Alignment of vectors of a fixed size [bytes].
#define EMMY_EIGEN_STATIC_ALIGN_BYTES 16
#endif
#ifndef EMMY_EIGEN_PLAIN_MALLOC
// 1: Eigen takes memory by malloc, whose alignment is enough.
#define EMMY_EIGEN_PLAIN_MALLOC 1
#endif

namespace emmy {

static_assert(
    EIGEN_DEFAULT_ALIGN_BYTES == EMMY_EIGEN_ALIGN_BYTES &&
        EIGEN_MAX_STATIC_ALIGN_BYTES == EMMY_EIGEN_STATIC_ALIGN_BYTES,
    "Eigen aligns vectors otherwise here than in the library Emmy. Compile "
    "without -mavx, -mavx2, -march=native and the like, and without EIGEN_... "
    "macros of alignment, or build Emmy itself with the same flags.");
static_assert(
    EIGEN_MALLOC_ALREADY_ALIGNED == EMMY_EIGEN_PLAIN_MALLOC ||
        EIGEN_DEFAULT_ALIGN_BYTES != EMMY_EIGEN_ALIGN_BYTES,
    "Eigen takes memory otherwise here than in the library Emmy. Where that is "
    "due to -fsanitize=address, add -DEIGEN_MALLOC_ALREADY_ALIGNED=1, or build "
    "Emmy itself with the same flags.");

using Vector3d = Eigen::Vector3d;              // A vector of space.
using Vector4d = Eigen::Vector4d;              // A quaternion (w, x, y, z).
using Vector6d = Eigen::Matrix<double, 6, 1>;  // Strains (ANCF-4).
using Vector9d = Eigen::Matrix<double, 9, 1>;  // e₁, e₂, e₃ in a column.
using VectorXd = Eigen::VectorXd;              // Of any size.
// Vectors of space side by side.
using Matrix3Xd = Eigen::Matrix<double, 3, Eigen::Dynamic>;
using Matrix3d = Eigen::Matrix3d;              // Such as e₁, e₂, e₃.
using Matrix9d = Eigen::Matrix<double, 9, 9>;  // Acts on a Vector9d.
using MatrixXd = Eigen::MatrixXd;              // Of any size.

}  // namespace emmy

#endif  // EMMY_BASE_TYPES_H_
