#include "emmy/numerics/polar.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace emmy {

PolarDecomposition DecomposePolar(const Matrix3d& f) {
  PolarDecomposition result;
  result.rotation.setConstant(std::numeric_limits<double>::quiet_NaN());
  result.stretch = result.rotation;
  const double determinant = f.determinant();
  if (!(determinant > 0.0) || !std::isfinite(determinant)) return result;

  Matrix3d x = f;
  constexpr int kMaxIterations = 100;  // From condition 1e12: about 45.
  for (int i = 0; i < kMaxIterations; ++i) {
    const Matrix3d inverse_transpose = x.inverse().transpose();
    // Scaling by ‖X⁻ᵀ‖/‖X‖ shortens the first phase for a large stretch.
    const double scale = std::sqrt(inverse_transpose.norm() / x.norm());
    const bool near = (x - inverse_transpose).cwiseAbs().maxCoeff() < 1e-2;
    const double factor = near ? 1.0 : scale;
    const Matrix3d next =
        0.5 * (factor * x + (1.0 / factor) * inverse_transpose);
    const double change = (next - x).cwiseAbs().maxCoeff();
    x = next;
    // Quadratic: a change below 1e-8 leaves an error below 1e-16.
    if (near && change < 1e-8) break;
  }
  result.rotation = x;
  const Matrix3d product = x.transpose() * f;
  result.stretch = 0.5 * (product + product.transpose());
  result.ok = true;
  return result;
}

}  // namespace emmy
