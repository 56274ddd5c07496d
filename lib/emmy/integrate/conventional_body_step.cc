#include "emmy/integrate/conventional_body_step.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>

#include "emmy/base/double_double.h"
#include "emmy/numerics/rotation.h"
#include "emmy/numerics/unit_roundoff.h"

namespace emmy {

// (CRB-5) at W̄ and J W̄.
Matrix3d ConventionalBodyStep::Jacobian(const Vector3d& mean,
                                        const Vector3d& momentum) const {
  const Matrix3d& tensor = body_.tensor();
  return tensor + (0.5 * time_step_) * (Hat(mean) * tensor - Hat(momentum));
}

// (CRB-4) at ΔW, evaluated in double-double arithmetic.
Vector3d ConventionalBodyStep::ExtendedResidual(
    const ConventionalBodyStart& start, const Vector3d& change) const {
  const Matrix3d& tensor = body_.tensor();
  std::array<DoubleDouble, 3> mean;
  std::array<DoubleDouble, 3> momentum;
  for (int i = 0; i < 3; ++i) {
    mean[static_cast<size_t>(i)] =
        DoubleDouble(TwoSum(start.angular_velocity(i),
                            start.angular_velocity_compensation(i))) +
        DoubleDouble(0.5 * change(i));
  }
  Vector3d residual;
  for (int i = 0; i < 3; ++i) {
    DoubleDouble sum;
    for (int j = 0; j < 3; ++j) {
      if (tensor(i, j) == 0.0) continue;
      sum += DoubleDouble(tensor(i, j)) * mean[static_cast<size_t>(j)];
    }
    momentum[static_cast<size_t>(i)] = sum;
  }
  for (int i = 0; i < 3; ++i) {
    const auto j = static_cast<size_t>((i + 1) % 3);
    const auto k = static_cast<size_t>((i + 2) % 3);
    DoubleDouble sum = DoubleDouble(time_step_) *
                       (mean[j] * momentum[k] - mean[k] * momentum[j]);
    for (int l = 0; l < 3; ++l) {
      if (tensor(i, l) == 0.0) continue;
      sum += DoubleDouble(TwoProduct(tensor(i, l), change(l)));
    }
    residual(i) = sum.ToDouble();
  }
  return residual;
}

BodyStepResult ConventionalBodyStep::Solve(
    const ConventionalBodyStart& start, const Vector3d& increment_guess,
    ConventionalBodyIncrement* increment) const {
  const Matrix3d& tensor = body_.tensor();
  const auto mean_of = [&start](const Vector3d& change) -> Vector3d {
    return start.angular_velocity +
           (start.angular_velocity_compensation + 0.5 * change);
  };
  BodyStepResult result;
  StagnationMonitor monitor;
  Vector3d change = increment_guess;
  Vector3d low = Vector3d::Zero();
  for (int i = 1; i <= options_.max_iterations; ++i) {
    result.iterations = i;
    const Vector3d mean = mean_of(change);
    const Vector3d momentum = tensor * mean;
    const Vector3d residual =
        tensor * change + time_step_ * mean.cross(momentum);
    const Vector3d correction = Jacobian(mean, momentum).inverse() * residual;
    for (int k = 0; k < 3; ++k) {
      const SumAndError difference = TwoSum(change(k), -correction(k));
      change(k) = difference.sum;
      low(k) = difference.error;
    }
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
      // A step of so many turns that rounding alone changes the momentum.
      const double rates =
          std::max({scale, start.angular_velocity.cwiseAbs().maxCoeff(),
                    change.cwiseAbs().maxCoeff()});
      if (!(floor <= kLargestShare * rates)) return result;
      result.termination = Termination::kConverged;
      break;
    }
  }
  increment->angular_velocity = change;
  // What the rounding of the residual hides, in extended precision: left in, it
  // has a small mean of its own and grows faster than a random walk.
  increment->angular_velocity_low =
      options_.tolerance.has_value()
          ? low
          : Vector3d(-(inverse_tensor_ * ExtendedResidual(start, change)));
  increment->quaternion =
      CayleyQuaternionIncrement(start.quaternion, time_step_ * mean_of(change));
  return result;
}

}  // namespace emmy
