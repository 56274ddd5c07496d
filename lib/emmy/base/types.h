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
#define EMMY_EIGEN_ALIGN_BYTES 16
#endif
#ifndef EMMY_EIGEN_STATIC_ALIGN_BYTES
#define EMMY_EIGEN_STATIC_ALIGN_BYTES 16
#endif
#ifndef EMMY_EIGEN_PLAIN_MALLOC
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

using Vector3d = Eigen::Vector3d;
using Vector4d = Eigen::Vector4d;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Vector9d = Eigen::Matrix<double, 9, 1>;
using VectorXd = Eigen::VectorXd;
using Matrix3Xd = Eigen::Matrix<double, 3, Eigen::Dynamic>;
using Matrix3d = Eigen::Matrix3d;
using Matrix9d = Eigen::Matrix<double, 9, 9>;
using MatrixXd = Eigen::MatrixXd;

}  // namespace emmy

#endif  // EMMY_BASE_TYPES_H_
