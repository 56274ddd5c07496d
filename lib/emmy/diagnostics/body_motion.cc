#include "emmy/diagnostics/body_motion.h"

#include "emmy/base/check.h"
#include "emmy/diagnostics/angular_velocity.h"
#include "emmy/numerics/polar.h"
#include "emmy/numerics/rotation.h"

namespace emmy {

BodyMotion ObserveBody(const Model& model, const State& state, size_t index) {
  EMMY_CHECK(index < model.bodies().size(),
             "body " << index << " of " << model.bodies().size());
  const ModelBody& body = model.bodies()[index];
  const Eigen::Index q = body.position_offset;
  const Eigen::Index w = body.velocity_offset;
  BodyMotion motion;
  motion.position = state.position.value.segment<3>(q);
  motion.velocity = state.velocity.value.segment<3>(w);
  if (body.conventional() != nullptr) {
    const Matrix3d rotation =
        QuaternionToMatrix(Vector4d(state.position.value.segment<4>(q + 3)));
    motion.quaternion = MatrixToQuaternion(rotation);
    motion.omega_locked = rotation * state.velocity.value.segment<3>(w + 3);
    motion.omega_polar = motion.omega_locked;
    motion.omega_polar_exact = motion.omega_locked;
    return motion;
  }
  const Matrix3d gradients =
      Eigen::Map<const Matrix3d>(state.position.value.data() + q + 3);
  const Matrix3d rates =
      Eigen::Map<const Matrix3d>(state.velocity.value.data() + w + 3);
  const PolarDecomposition polar = DecomposePolar(gradients);
  motion.quaternion = polar.ok
                          ? MatrixToQuaternion(polar.rotation)
                          : Vector4d::Constant(polar.rotation(0, 0)).eval();
  motion.omega_locked =
      LockedAngularVelocity(body.ancf()->second_moment(), gradients, rates);
  motion.omega_polar = PolarAngularVelocity(polar, rates);
  motion.omega_polar_exact = ExactPolarAngularVelocity(polar, rates);
  return motion;
}

}  // namespace emmy
