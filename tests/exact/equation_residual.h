// How well a proposed motion satisfies the equations of the torque-free body.

#ifndef EMMY_TESTS_EXACT_EQUATION_RESIDUAL_H_
#define EMMY_TESTS_EXACT_EQUATION_RESIDUAL_H_

#include <cmath>
#include <functional>

#include "verification/exact/attitude.h"
#include "verification/exact/free_rigid_body.h"

namespace emmy::exact {

// A motion t ↦ state in Quad precision.
using QuadMotion = std::function<FreeRigidBodyState<Quad>(const Quad&)>;

// Central differences of order 2p over ±p h:
//   ḟ ≈ Σ w_j (f(t + j h) − f(t − j h)) / h,
//   w_j = (−1)^(j+1) (p!)² / (j (p−j)! (p+j)!),   Σ 2 |w_j| < 4.
// With v no less than |ω| on the orbit (v = L / J₁), |l̇| ≤ |l|² / J₁ holds
// for complex time too, so that l is analytic and |l| ≤ 2 L for |Δt| ≤ ½ / v,
// and |R| ≤ e there. Cauchy's estimate then bounds the truncation by
//   M (p!)² (2 v)^(2p+1) h^2p (1 + …),  M = 2 v for ω and e for R,
// here with p = 8 and h = 2^−10 / v: below 1e-33 v. What is left is rounding:
// an error of the values divided by h.
class EquationResidual {
 public:
  static constexpr int kHalfWidth = 8;
  static constexpr double kStep = 0x1p-10;  // h v

  EquationResidual(const Matrix3<Quad>& inertia, const Quad& speed)
      : inertia_(inertia), speed_(speed) {}

  // max(‖Ṙ − R ω̂‖ / v, ‖J ω̇ + ω × J ω‖ / (‖J‖ v²)), largest entries.
  Quad operator()(const QuadMotion& motion, const Quad& time) const {
    const Quad h = Quad(kStep) / speed_;
    Matrix3<Quad> attitude_rate = Matrix3<Quad>::Zero();
    Vector3<Quad> omega_rate = Vector3<Quad>::Zero();
    Quad weight = -1;
    for (int j = 1; j <= kHalfWidth; ++j) {
      // (p!)² / ((p−j)! (p+j)!) from its predecessor.
      weight *= -Quad(kHalfWidth - j + 1) / (kHalfWidth + j);
      const FreeRigidBodyState<Quad> after = motion(time + j * h);
      const FreeRigidBodyState<Quad> before = motion(time - j * h);
      const Quad w = weight / (j * h);
      attitude_rate += w * (after.attitude - before.attitude);
      omega_rate +=
          w * (after.body_angular_velocity - before.body_angular_velocity);
    }
    const FreeRigidBodyState<Quad> now = motion(time);
    const Vector3<Quad>& omega = now.body_angular_velocity;
    const Matrix3<Quad> kinematic = attitude_rate - now.attitude * Hat(omega);
    const Vector3<Quad> momentum = inertia_ * omega;
    const Vector3<Quad> euler = inertia_ * omega_rate + omega.cross(momentum);
    const Quad a = kinematic.cwiseAbs().maxCoeff() / speed_;
    const Quad b = euler.cwiseAbs().maxCoeff() /
                   (inertia_.cwiseAbs().maxCoeff() * speed_ * speed_);
    return a < b ? b : a;
  }

  // c u (1 + v |t|) relative error of the values, divided by h v.
  Quad Bound(const Quad& time, int c) const {
    using std::abs;
    return c * Epsilon<Quad>() / 2 * 4 * (1 + speed_ * abs(time)) / kStep;
  }

 private:
  Matrix3<Quad> inertia_;
  Quad speed_;
};

}  // namespace emmy::exact

#endif  // EMMY_TESTS_EXACT_EQUATION_RESIDUAL_H_
