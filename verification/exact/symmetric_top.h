// The torque-free body with two equal moments, in elementary functions.
//
//   J = diag(I, I, J₃) in body axes,  L = R J ω = const.
//   s = ω₃ (I − J₃) / I                                  [rad/s]  (TOP-12)
//   R(t) = exp(t L̂ / I) R(0) exp(t s e₃)                          (TOP-13)
//   ω(t) = exp(−t s e₃) ω(0)             (body axes)              (TOP-14)
//
// The body turns about its axis at the rate s while it is carried about the
// fixed L at the rate |L| / I. Independent of free_rigid_body.h, which it
// checks.
//
// Error: a few u (1 + |ω| t) for T's unit round-off u.
//
// Derivation: docs/theory.md (TOP-12..14), after Landau & Lifshitz,
// Mechanics, §33; Kane, Likins & Levinson, Spacecraft Dynamics (1983).

#ifndef EMMY_VERIFICATION_EXACT_SYMMETRIC_TOP_H_
#define EMMY_VERIFICATION_EXACT_SYMMETRIC_TOP_H_

#include "verification/exact/free_rigid_body.h"
#include "verification/exact/real.h"

namespace emmy::exact {

template <typename T>
struct SymmetricTop {
  T transverse_moment = T{1};                             // I  [kg m²], > 0
  T axial_moment = T{1};                                  // J₃ [kg m²], > 0
  Matrix3<T> attitude = Matrix3<T>::Identity();           // R(0)
  Vector3<T> body_angular_velocity = Vector3<T>::Zero();  // ω(0) [rad/s]
};

// State at any time t [s].
template <typename T>
FreeRigidBodyState<T> SymmetricTopAt(const SymmetricTop<T>& top, const T& time);

}  // namespace emmy::exact

#endif  // EMMY_VERIFICATION_EXACT_SYMMETRIC_TOP_H_
