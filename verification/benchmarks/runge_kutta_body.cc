#include "verification/benchmarks/runge_kutta_body.h"

#include <cmath>
#include <cstddef>

namespace emmy::verification {

RungeKuttaBody::RungeKuttaBody(const std::array<double, 3>& inertia,
                               const std::array<double, 3>& angular_velocity)
    : inertia_(inertia),
      ratio_({(inertia[1] - inertia[2]) / inertia[0],
              (inertia[2] - inertia[0]) / inertia[1],
              (inertia[0] - inertia[1]) / inertia[2]}),
      motion_({{1.0, 0.0, 0.0, 0.0}, angular_velocity}) {}

RungeKuttaBody::Motion RungeKuttaBody::Rates(const Motion& motion) const {
  const auto& [w, x, y, z] = motion.quaternion;
  const auto& [a, b, c] = motion.angular_velocity;
  return {{-0.5 * (x * a + y * b + z * c), 0.5 * (w * a + y * c - z * b),
           0.5 * (w * b + z * a - x * c), 0.5 * (w * c + x * b - y * a)},
          {ratio_[0] * (b * c), ratio_[1] * (c * a), ratio_[2] * (a * b)}};
}

void RungeKuttaBody::Step(double time_step) {
  const auto advanced = [this](double time, const Motion& rates) {
    Motion result = motion_;
    for (size_t i = 0; i < 4; ++i) {
      result.quaternion[i] += time * rates.quaternion[i];
    }
    for (size_t i = 0; i < 3; ++i) {
      result.angular_velocity[i] += time * rates.angular_velocity[i];
    }
    return result;
  };
  const Motion k1 = Rates(motion_);
  const Motion k2 = Rates(advanced(0.5 * time_step, k1));
  const Motion k3 = Rates(advanced(0.5 * time_step, k2));
  const Motion k4 = Rates(advanced(time_step, k3));
  const double sixth = time_step / 6.0;
  double square = 0.0;
  for (size_t i = 0; i < 4; ++i) {
    double& q = motion_.quaternion[i];
    q += sixth * (k1.quaternion[i] + 2.0 * k2.quaternion[i] +
                  2.0 * k3.quaternion[i] + k4.quaternion[i]);
    square += q * q;
  }
  for (size_t i = 0; i < 3; ++i) {
    motion_.angular_velocity[i] +=
        sixth * (k1.angular_velocity[i] + 2.0 * k2.angular_velocity[i] +
                 2.0 * k3.angular_velocity[i] + k4.angular_velocity[i]);
  }
  const double scale = 1.0 / std::sqrt(square);
  for (double& q : motion_.quaternion) q *= scale;
}

double RungeKuttaBody::Energy() const {
  double energy = 0.0;
  for (size_t i = 0; i < 3; ++i) {
    const double omega = motion_.angular_velocity[i];
    energy += 0.5 * inertia_[i] * omega * omega;
  }
  return energy;
}

}  // namespace emmy::verification
