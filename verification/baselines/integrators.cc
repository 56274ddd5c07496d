#include "verification/baselines/integrators.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

namespace emmy::verification {
namespace {

constexpr int kMaxIterations = 60;
constexpr double kTolerance = 1e-11;

VectorXd AccelerationAt(const ElasticSystem& system, const VectorXd& q) {
  return -system.mass.llt().solve(InternalForce(system, q));
}

// What a method makes of its unknown x.
struct Equation {
  VectorXd residual;
  MatrixXd jacobian;
};

// Newton's method for r(x) = 0. `position_per_unknown` times a correction is
// that of q, whose size is `scale`.
template <typename Evaluate>
StepReport SolveNewton(const Evaluate& evaluate, double position_per_unknown,
                       double scale, VectorXd* unknown) {
  StepReport report;
  for (report.iterations = 1; report.iterations <= kMaxIterations;
       ++report.iterations) {
    const Equation equation = evaluate(*unknown);
    const VectorXd correction =
        -equation.jacobian.partialPivLu().solve(equation.residual);
    if (!correction.allFinite()) {
      report.termination = Termination::kNonFinite;
      report.message = "a baseline's iteration ran away";
      return report;
    }
    *unknown += correction;
    report.correction = position_per_unknown * correction.cwiseAbs().maxCoeff();
    if (report.correction <= kTolerance * scale) {
      report.termination = Termination::kConverged;
      return report;
    }
  }
  report.termination = Termination::kMaxIterations;
  report.message = "a baseline's iteration did not converge";
  return report;
}

// What a step may add to q is part of its size: q itself may be zero.
double SizeOfPosition(const Motion& motion, double dt) {
  return motion.position.cwiseAbs().maxCoeff() +
         dt * motion.velocity.cwiseAbs().maxCoeff() +
         dt * dt * motion.acceleration.cwiseAbs().maxCoeff();
}

}  // namespace

Motion StartMotion(const ElasticSystem& system, const VectorXd& position,
                   const VectorXd& velocity) {
  return {position, velocity, AccelerationAt(system, position)};
}

GeneralizedAlpha GeneralizedAlpha::WithSpectralRadius(double rho) {
  GeneralizedAlpha parameters;
  parameters.alpha_m = (2.0 * rho - 1.0) / (rho + 1.0);
  parameters.alpha_f = rho / (rho + 1.0);
  const double difference = parameters.alpha_f - parameters.alpha_m;
  parameters.gamma = 0.5 + difference;
  parameters.beta = 0.25 * (1.0 + difference) * (1.0 + difference);
  return parameters;
}

StepReport StepGeneralizedAlpha(const ElasticSystem& system, double time_step,
                                const GeneralizedAlpha& parameters,
                                Motion* motion) {
  const double dt = time_step;
  const double alpha_m = parameters.alpha_m;
  const double alpha_f = parameters.alpha_f;
  const double beta = parameters.beta;
  const double gamma = parameters.gamma;
  const VectorXd& a0 = motion->acceleration;
  const VectorXd start =
      motion->position + dt * motion->velocity + dt * dt * (0.5 - beta) * a0;
  const VectorXd start_terms =
      alpha_m * (system.mass * a0) +
      alpha_f * InternalForce(system, motion->position);
  VectorXd a1 = a0;
  const auto evaluate = [&](const VectorXd& a) {
    const VectorXd q = start + dt * dt * beta * a;
    return Equation{
        (1.0 - alpha_m) * (system.mass * a) +
            (1.0 - alpha_f) * InternalForce(system, q) + start_terms,
        (1.0 - alpha_m) * system.mass +
            (1.0 - alpha_f) * dt * dt * beta * Stiffness(system, q)};
  };
  StepReport report =
      SolveNewton(evaluate, dt * dt * beta, SizeOfPosition(*motion, dt), &a1);
  if (!report.ok()) return report;
  motion->position = start + dt * dt * beta * a1;
  motion->velocity += dt * ((1.0 - gamma) * a0 + gamma * a1);
  motion->acceleration = a1;
  return report;
}

StepReport StepMidpoint(const ElasticSystem& system, double time_step,
                        Motion* motion) {
  const double dt = time_step;
  const VectorXd& w0 = motion->velocity;
  VectorXd w1 = w0;
  const auto evaluate = [&](const VectorXd& w) {
    const VectorXd middle = motion->position + 0.25 * dt * (w0 + w);
    return Equation{system.mass * (w - w0) + dt * InternalForce(system, middle),
                    system.mass + 0.25 * dt * dt * Stiffness(system, middle)};
  };
  StepReport report = SolveNewton(evaluate, 0.5 * std::abs(dt),
                                  SizeOfPosition(*motion, dt), &w1);
  if (!report.ok()) return report;
  motion->position += 0.5 * dt * (w0 + w1);
  motion->velocity = w1;
  return report;
}

StepReport StepVerlet(const ElasticSystem& system, double time_step,
                      Motion* motion) {
  const double dt = time_step;
  const VectorXd q = motion->position + dt * motion->velocity +
                     0.5 * dt * dt * motion->acceleration;
  const VectorXd a1 = AccelerationAt(system, q);
  const VectorXd w1 = motion->velocity + 0.5 * dt * (motion->acceleration + a1);
  StepReport report;
  report.iterations = 1;
  if (!q.allFinite() || !w1.allFinite()) {
    report.termination = Termination::kNonFinite;
    report.message = "the explicit step ran away";
    return report;
  }
  report.termination = Termination::kConverged;
  *motion = {q, w1, a1};
  return report;
}

}  // namespace emmy::verification
