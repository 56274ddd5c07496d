// Principal moments and axes of an inertia tensor.
//
//   J = Q diag(J₁, J₂, J₃) Qᵀ,  J₁ ≤ J₂ ≤ J₃,  det Q = +1          (TOP-1)
//
// By cyclic Jacobi rotations: |error| of each moment and of Qᵀ Q is a few ε
// relative to J₃. A diagonal tensor is only sorted, so its moments are exact;
// equal moments stay exactly equal.

#ifndef EMMY_VERIFICATION_EXACT_PRINCIPAL_AXES_H_
#define EMMY_VERIFICATION_EXACT_PRINCIPAL_AXES_H_

#include "absl/status/statusor.h"
#include "verification/exact/real.h"

namespace emmy::exact {

template <typename T>
struct PrincipalAxes {
  Vector3<T> moments;  // J₁ ≤ J₂ ≤ J₃ [kg m²]
  Matrix3<T> axes;     // Q: principal → body axes.
};

// Fails with kInvalidArgument if `inertia` is not finite and symmetric, or
// if no body of finite extent has it (J₁ > 0 and J₁ + J₂ > J₃ are needed).
template <typename T>
absl::StatusOr<PrincipalAxes<T>> FindPrincipalAxes(const Matrix3<T>& inertia);

}  // namespace emmy::exact

#endif  // EMMY_VERIFICATION_EXACT_PRINCIPAL_AXES_H_
