#include "emmy/integrate/conventional_body_step.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "emmy/numerics/rotation.h"

namespace emmy {

// (CRB-5) at W̄ and J W̄.
Matrix3d ConventionalBodyStep::Jacobian(const Vector3d& mean,
                                        const Vector3d& momentum) const {
  const Matrix3d& tensor = body_.tensor();
  return tensor + (0.5 * time_step_) * (Hat(mean) * tensor - Hat(momentum));
}

BodyStepResult ConventionalBodyStep::Solve(
    const ConventionalBodyStart& start, const Vector3d& increment_guess,
    ConventionalBodyIncrement* increment) const {
  constexpr double kUnitRoundoff = std::numeric_limits<double>::epsilon() / 2.0;
  const Matrix3d& tensor = body_.tensor();
  const auto mean_of = [&start](const Vector3d& change) -> Vector3d {
    return start.angular_velocity +
           (start.angular_velocity_compensation + 0.5 * change);
  };
  BodyStepResult result;
  StagnationMonitor monitor;
  Vector3d change = increment_guess;
  for (int i = 1; i <= options_.max_iterations; ++i) {
    result.iterations = i;
    const Vector3d mean = mean_of(change);
    const Vector3d momentum = tensor * mean;
    const Vector3d residual =
        tensor * change + time_step_ * mean.cross(momentum);
    // Two digits an iteration with J alone; below that Newton's method pays.
    constexpr double kSmall = 0.01;
    const bool small = std::abs(time_step_) * mean.norm() < kSmall;
    const Vector3d correction =
        small ? Vector3d(inverse_tensor_ * residual)
              : Vector3d(Jacobian(mean, momentum).inverse() * residual);
    change -= correction;
    result.correction = correction.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    if (!std::isfinite(result.correction)) {
      result.termination = Termination::kNonFinite;
      return result;
    }
    const double scale = mean.cwiseAbs().maxCoeff();
    // The residual is rounded by u times its terms, divided by J.
    const double floor = kUnitRoundoff * (change.cwiseAbs().maxCoeff() +
                                          std::abs(time_step_) * scale *
                                              momentum.cwiseAbs().maxCoeff() /
                                              tensor.diagonal().minCoeff());
    const bool done = options_.tolerance.has_value()
                          ? result.correction <= *options_.tolerance * scale
                          : monitor.Update(result.correction, floor);
    if (done) {
      result.termination = Termination::kConverged;
      break;
    }
  }
  increment->angular_velocity = change;
  increment->quaternion =
      CayleyQuaternionIncrement(start.quaternion, time_step_ * mean_of(change));
  return result;
}

}  // namespace emmy
