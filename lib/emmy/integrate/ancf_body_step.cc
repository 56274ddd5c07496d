#include "emmy/integrate/ancf_body_step.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "emmy/numerics/rotation.h"
#include "emmy/numerics/unit_roundoff.h"

namespace emmy {
namespace {

// NaN if any entry is.
double MaxAbs(const Matrix3d& m) {
  return m.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

// The moment Σ ēᵢ × rᵢ left by a residual. Judged apart from the corrections,
// whose strain part is rounded 1/|Δe| times coarser and would hide a rotation
// that has not converged; angular momentum would drift.
double MaxMoment(const Matrix3d& mean_gradients, const Matrix3d& residual) {
  const Vector3d moment = mean_gradients.col(0).cross(residual.col(0)) +
                          mean_gradients.col(1).cross(residual.col(1)) +
                          mean_gradients.col(2).cross(residual.col(2));
  return moment.cwiseAbs().maxCoeff();
}

}  // namespace

struct AncfBodyStep::Evaluation {
  Matrix3d increment;       // Δe
  Matrix3d mean_rates;      // w̄
  Matrix3d mean_gradients;  // ē
  Vector6d strain_increment;
  Vector6d mean_stress;  // b ε̄
  Matrix3d residual;     // (EM-2)
};

AncfBodyStep::AncfBodyStep(const AncfRigidBody& body, double time_step,
                           const NewtonOptions& options, Tangent tangent)
    : body_(body),
      time_step_(time_step),
      options_(options),
      tangent_(tangent),
      corotated_(body, time_step) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(body.second_moment(),
                                                       Eigen::EigenvaluesOnly);
  smallest_moment_sum_ = solver.eigenvalues()(0) + solver.eigenvalues()(1);
  inverse_moment_ = body.second_moment().inverse();
  const double largest_c =
      0.25 * time_step * time_step * body.penalty_stiffness().maxCoeff();
  constexpr double kNegligible = 1e-3;  // Three digits an iteration.
  mass_dominates_ = largest_c < kNegligible * solver.eigenvalues()(0);
}

AncfBodyStep::Evaluation AncfBodyStep::Evaluate(
    const AncfBodyStart& start, const Matrix3d& rate_increment) const {
  Evaluation e;
  e.mean_rates =
      start.rates + (start.rates_compensation + 0.5 * rate_increment);
  e.increment = time_step_ * e.mean_rates;
  e.mean_gradients =
      start.gradients + (start.gradients_compensation + 0.5 * e.increment);
  e.strain_increment =
      AncfRigidBody::StrainIncrement(e.mean_gradients, e.increment);
  const Vector6d mean_strain =
      start.strain + (start.strain_compensation + 0.5 * e.strain_increment);
  e.mean_stress = body_.penalty_stiffness().cwiseProduct(mean_strain);
  e.residual = rate_increment * body_.second_moment() +
               time_step_ * body_.InternalForce(e.mean_gradients, mean_strain);
  return e;
}

// Jacobian of (EM-2): M + ¼ Δt² [stress terms + b (A ē)(A e₁)ᵀ].
bool AncfBodyStep::FullNewtonCorrection(const Evaluation& evaluation,
                                        Matrix3d* correction) const {
  const double quarter = 0.25 * time_step_ * time_step_;
  const Matrix3d& mean = evaluation.mean_gradients;
  const Matrix3d end = mean + 0.5 * evaluation.increment;
  Matrix9d jacobian;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      jacobian.block<3, 3>(3 * i, 3 * j) =
          body_.second_moment()(i, j) * Matrix3d::Identity();
    }
  }
  for (int i = 0; i < 3; ++i) {
    const double c = quarter * body_.penalty_stiffness()(i);
    jacobian.block<3, 3>(3 * i, 3 * i) +=
        c * mean.col(i) * end.col(i).transpose() +
        quarter * evaluation.mean_stress(i) * Matrix3d::Identity();
    const auto [m, n] = AncfRigidBody::kShearPairs[static_cast<size_t>(i)];
    const double shear_c = quarter * body_.penalty_stiffness()(3 + i);
    const Matrix3d shear_stress =
        quarter * evaluation.mean_stress(3 + i) * Matrix3d::Identity();
    jacobian.block<3, 3>(3 * m, 3 * m) +=
        shear_c * mean.col(n) * end.col(n).transpose();
    jacobian.block<3, 3>(3 * m, 3 * n) +=
        shear_c * mean.col(n) * end.col(m).transpose() + shear_stress;
    jacobian.block<3, 3>(3 * n, 3 * m) +=
        shear_c * mean.col(m) * end.col(n).transpose() + shear_stress;
    jacobian.block<3, 3>(3 * n, 3 * n) +=
        shear_c * mean.col(m) * end.col(m).transpose();
  }
  const Eigen::PartialPivLU<Matrix9d> factor(jacobian);
  const Vector9d solution =
      factor.solve(Eigen::Map<const Vector9d>(evaluation.residual.data()));
  *correction = Eigen::Map<const Matrix3d>(solution.data());
  return solution.allFinite();
}

// Δw of a rigid turn of e₀ by the Cayley map of Δt ω: no strain, so that a
// stiff penalty does not throw the first correction far off.        (EM-8)
Matrix3d AncfBodyStep::RigidTurnGuess(const AncfBodyStart& start) const {
  const Matrix3d& e = start.gradients;
  const Matrix3d& w = start.rates;
  Vector3d momentum = Vector3d::Zero();
  Matrix3d inertia = Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double moment = body_.second_moment()(i, j);
      momentum += moment * e.col(i).cross(w.col(j));
      inertia += moment * (e.col(i).dot(e.col(j)) * Matrix3d::Identity() -
                           e.col(i) * e.col(j).transpose());
    }
  }
  const Vector3d omega = inertia.inverse() * momentum;
  const Matrix3d turn = CayleyRotation(time_step_ * omega);
  return 2.0 * ((turn * e - e) / time_step_ - w);
}

BodyStepResult AncfBodyStep::Iterate(const AncfBodyStart& start,
                                     bool full_newton,
                                     Matrix3d* rate_increment) const {
  BodyStepResult result;
  // Where the penalty is stiff, strain is defined to its floor only, and what a
  // step leaves of it does no work: the mean strain rate vanishes.
  StagnationMonitor strain_monitor(mass_dominates_ ? 0x1p-10 : 0x1p-6);
  StagnationMonitor rotation_monitor;
  double previous = std::numeric_limits<double>::infinity();
  for (int i = 1; i <= options_.max_iterations; ++i) {
    result.iterations = i;
    const Evaluation e = Evaluate(start, *rate_increment);
    Matrix3d correction;
    if (!full_newton && mass_dominates_) {
      correction = e.residual * inverse_moment_;
    } else if (!full_newton) {
      // Residual along ēⱼ, correction along the dual vectors of e₁: then the
      // penalty terms of (EM-6) are those of the exact Jacobian, and the mass
      // is seen through both frames, turned by half a step: once more for what
      // that leaves.
      const Matrix3d end = e.mean_gradients + 0.5 * e.increment;
      const Matrix3d to_mean = e.mean_gradients.inverse();
      const Matrix3d from_end = end.inverse().transpose();
      const Matrix3d turn = to_mean * from_end - Matrix3d::Identity();
      const Matrix3d along = to_mean * e.residual;
      const Matrix3d first = corotated_.Solve(along);
      correction = from_end * corotated_.Solve(
                                  along - turn * first * body_.second_moment());
    } else if (!FullNewtonCorrection(e, &correction)) {
      result.termination = Termination::kSingularTangent;
      return result;
    }
    *rate_increment -= correction;
    result.correction = MaxAbs(correction);
    if (!std::isfinite(result.correction)) {
      result.termination = Termination::kNonFinite;
      return result;
    }

    const double rate_scale = MaxAbs(e.mean_rates);
    if (options_.tolerance.has_value()) {
      if (result.correction <= *options_.tolerance * rate_scale) {
        result.termination = Termination::kConverged;
        return result;
      }
    } else {
      // A strain increment is rounded by about u |ē| |Δe|, which a correction
      // of 4 u |w| undoes; a rotation by the rounding of the residual.
      const double strain_floor = 4.0 * kUnitRoundoff * rate_scale;
      const double rotation_floor =
          kUnitRoundoff *
          (MaxAbs(*rate_increment) + std::abs(time_step_) *
                                         e.mean_stress.cwiseAbs().maxCoeff() /
                                         smallest_moment_sum_);
      // Both monitors must see every correction.
      const bool strain_done =
          strain_monitor.Update(result.correction, strain_floor);
      const bool rotation_done = rotation_monitor.Update(
          MaxMoment(e.mean_gradients, e.residual) / smallest_moment_sum_,
          rotation_floor);
      if (strain_done && rotation_done) {
        // A penalty so stiff that the rounding of its stress turns the body is
        // no residual that an iteration could take away.
        const double rates = std::max(
            {rate_scale, MaxAbs(start.rates), MaxAbs(*rate_increment)});
        if (rotation_floor <= kLargestShare * rates) {
          result.termination = Termination::kConverged;
        }
        return result;
      }
      constexpr double kSlow = 0.3;
      const bool far = result.correction > 1e3 * strain_floor;
      if (!full_newton && far && i > 1 &&
          result.correction > kSlow * previous) {
        return result;  // kMaxIterations: the caller changes the tangent.
      }
    }
    previous = result.correction;
  }
  return result;
}

BodyStepResult AncfBodyStep::Solve(const AncfBodyStart& start,
                                   const Matrix3d& rate_increment_guess,
                                   AncfBodyIncrement* increment) const {
  BodyStepResult result;
  int iterations = 0;
  increment->rates = rate_increment_guess;
  if (tangent_ == Tangent::kAutomatic) {
    result = Iterate(start, /*full_newton=*/false, &increment->rates);
    iterations += result.iterations;
  }
  if (result.termination != Termination::kConverged) {
    increment->rates = RigidTurnGuess(start);
    result = Iterate(start, /*full_newton=*/true, &increment->rates);
    iterations += result.iterations;
  }
  if (result.termination != Termination::kConverged) {
    // A soft, strongly strained body: the last increment is the better start.
    increment->rates = rate_increment_guess;
    result = Iterate(start, /*full_newton=*/true, &increment->rates);
    iterations += result.iterations;
  }
  result.iterations = iterations;
  const Evaluation final_evaluation = Evaluate(start, increment->rates);
  increment->gradients = final_evaluation.increment;
  increment->strain = final_evaluation.strain_increment;
  return result;
}

}  // namespace emmy
