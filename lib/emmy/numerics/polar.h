// Right polar decomposition of a 3×3 matrix.
//
//   F = R̃ U, R̃ᵀR̃ = 1, det R̃ = 1, U symmetric positive definite   (ATT-1)
//
// By Newton's iteration X ← ½ (X + X⁻ᵀ) (Higham, Functions of Matrices,
// SIAM 2008, 8.3), quadratically convergent. The factors are good to about u
// times the square of F's condition number, which is 1 for a rotation; beyond
// 1e8 the determinant may be lost to rounding and F refused.

#ifndef EMMY_NUMERICS_POLAR_H_
#define EMMY_NUMERICS_POLAR_H_

#include "emmy/base/export.h"
#include "emmy/base/types.h"

namespace emmy {

struct PolarDecomposition {
  Matrix3d rotation;  // R̃
  Matrix3d stretch;   // U
  // False where det F is not a positive number: the body is turned inside
  // out, there is no attitude, and both matrices are NaN.
  bool ok = false;
};

// (ATT-1); `ok` says whether there is one.
EMMY_EXPORT PolarDecomposition DecomposePolar(const Matrix3d& f);

}  // namespace emmy

#endif  // EMMY_NUMERICS_POLAR_H_
