// Fixed-size vectors and matrices used throughout the library.

#ifndef EMMY_BASE_TYPES_H_
#define EMMY_BASE_TYPES_H_

#include <Eigen/Core>

namespace emmy {

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
