// Numerical integration of the torque-free body, independent of its closed
// form: Taylor series of (TOP-3) in Quad.

#ifndef EMMY_TESTS_EXACT_TAYLOR_INTEGRATOR_H_
#define EMMY_TESTS_EXACT_TAYLOR_INTEGRATOR_H_

#include <array>

#include "verification/exact/free_rigid_body.h"

namespace emmy::exact {

// With ω = Σ ω_k t^k and R = Σ R_k t^k,
//   (k+1) J ω_{k+1} = Σ_i (J ω_i) × ω_{k−i},
//   (k+1) R_{k+1} = Σ_i R_i ω̂_{k−i}.
// The coefficients are at most e (2 v)^k for v = L / J₁ (equation_residual.h);
// at a step of 1 / (16 v) the series is cut at 8^−37 = 4e-34, the round-off.
class TaylorIntegrator {
 public:
  static constexpr int kOrder = 36;
  static constexpr int kStepsPerRadian = 16;

  // The tensor must be diagonal.
  TaylorIntegrator(const FreeRigidBodyStart<Quad>& start, const Quad& speed)
      : moments_(start.inertia.diagonal()),
        step_(1 / (kStepsPerRadian * speed)) {
    state_.attitude = start.attitude;
    state_.body_angular_velocity = start.angular_velocity;
  }

  // Advances by `steps` of 1 / (kStepsPerRadian · speed).
  void Advance(int steps) {
    for (int i = 0; i < steps; ++i) Step();
    time_ += steps * step_;
  }

  const Quad& time() const { return time_; }
  // Attitude and body angular velocity; the other fields are not set.
  const FreeRigidBodyState<Quad>& state() const { return state_; }

 private:
  void Step() {
    std::array<Vector3<Quad>, kOrder + 1> omega;
    std::array<Vector3<Quad>, kOrder + 1> momentum;
    std::array<Matrix3<Quad>, kOrder + 1> attitude;
    omega[0] = state_.body_angular_velocity;
    momentum[0] = moments_.cwiseProduct(omega[0]);
    attitude[0] = state_.attitude;
    for (size_t k = 0; k < kOrder; ++k) {
      Vector3<Quad> torque = Vector3<Quad>::Zero();
      Matrix3<Quad> turn = Matrix3<Quad>::Zero();
      for (size_t i = 0; i <= k; ++i) {
        torque += momentum[i].cross(omega[k - i]);
        // Row by row, R_i ω̂ = (row × ω) for each row of R_i.
        for (int row = 0; row < 3; ++row) {
          turn.row(row) += attitude[i].row(row).cross(omega[k - i].transpose());
        }
      }
      momentum[k + 1] = torque / Quad(k + 1);
      omega[k + 1] = momentum[k + 1].cwiseQuotient(moments_);
      attitude[k + 1] = turn / Quad(k + 1);
    }
    state_.body_angular_velocity = omega[kOrder];
    state_.attitude = attitude[kOrder];
    for (size_t k = kOrder; k-- > 0;) {
      state_.body_angular_velocity =
          (omega[k] + step_ * state_.body_angular_velocity).eval();
      state_.attitude = (attitude[k] + step_ * state_.attitude).eval();
    }
  }

  Vector3<Quad> moments_;
  Quad step_;
  Quad time_ = 0;
  FreeRigidBodyState<Quad> state_;
};

}  // namespace emmy::exact

#endif  // EMMY_TESTS_EXACT_TAYLOR_INTEGRATOR_H_
