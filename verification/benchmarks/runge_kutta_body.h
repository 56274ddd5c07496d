// The yardstick: a torque-free rigid body by the classical Runge–Kutta method,
// as one would write it first: Euler's equations in principal axes and a unit
// quaternion (w, x, y, z), plain doubles, normalised after each step.
//
//   J ω̇ = J ω × ω,  q̇ = ½ q ∘ (0, ω)                            (BENCH-1)
//
// Loses energy and angular momentum at its fifth order and to round-off.

#ifndef EMMY_VERIFICATION_BENCHMARKS_RUNGE_KUTTA_BODY_H_
#define EMMY_VERIFICATION_BENCHMARKS_RUNGE_KUTTA_BODY_H_

#include <array>

namespace emmy::verification {

class RungeKuttaBody {
 public:
  // Principal moments of inertia [kg m²]; body axes are the inertial ones at
  // the start; angular velocity [rad/s].
  RungeKuttaBody(const std::array<double, 3>& inertia,
                 const std::array<double, 3>& angular_velocity);

  void Step(double time_step);
  double Energy() const;  // [J]

  // Body to inertial axes, (w, x, y, z); in body axes [rad/s].
  const std::array<double, 4>& quaternion() const { return motion_.quaternion; }
  const std::array<double, 3>& angular_velocity() const {
    return motion_.angular_velocity;
  }

 private:
  struct Motion {
    std::array<double, 4> quaternion;        // Body to inertial axes.
    std::array<double, 3> angular_velocity;  // In body axes.
  };

  Motion Rates(const Motion& motion) const;

  std::array<double, 3> inertia_;
  std::array<double, 3> ratio_;  // (J₂ − J₃)/J₁ and so on.
  Motion motion_;
};

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_BENCHMARKS_RUNGE_KUTTA_BODY_H_
