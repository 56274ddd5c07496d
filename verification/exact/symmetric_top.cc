#include "verification/exact/symmetric_top.h"

#include "emmy/base/check.h"
#include "verification/exact/attitude.h"

namespace emmy::exact {

template <typename T>
FreeRigidBodyState<T> SymmetricTopAt(const SymmetricTop<T>& top,
                                     const T& time) {
  const T& transverse = top.transverse_moment;
  const T& axial = top.axial_moment;
  EMMY_CHECK(transverse > 0 && axial > 0,
             "moments = " << transverse << ", " << axial);
  const Vector3<T> moments(transverse, transverse, axial);
  const Vector3<T> start = top.body_angular_velocity;
  const Vector3<T> momentum = top.attitude * moments.cwiseProduct(start);
  const T spin = start(2) * (transverse - axial) / transverse;
  const Vector3<T> carried = momentum * (time / transverse);
  const Vector3<T> turned(T{0}, T{0}, spin * time);

  const Matrix3<T> spin_turn = RotationFromVector(turned);
  FreeRigidBodyState<T> state;
  state.attitude = RotationFromVector(carried) * top.attitude * spin_turn;
  state.body_angular_velocity = spin_turn.transpose() * start;
  state.angular_velocity = state.attitude * state.body_angular_velocity;
  state.angular_momentum = momentum;
  return state;
}

template FreeRigidBodyState<double> SymmetricTopAt(const SymmetricTop<double>&,
                                                   const double&);
template FreeRigidBodyState<Quad> SymmetricTopAt(const SymmetricTop<Quad>&,
                                                 const Quad&);

}  // namespace emmy::exact
