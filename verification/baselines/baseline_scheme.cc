#include "verification/baselines/baseline_scheme.h"

#include <memory>
#include <utility>

#include "verification/baselines/integrators.h"

namespace emmy::verification {
namespace {

// One run by one method.
class Stepper {
 public:
  Stepper(const Model& model, ElasticSystem system, Baseline baseline,
          double time_step)
      : model_(&model),
        system_(std::move(system)),
        baseline_(baseline),
        time_step_(time_step) {}

  StepReport Step(State& state) {
    // The acceleration of generalised α is not a function of q and w: it is
    // kept here as long as the run goes on, from the state it was left in.
    const VectorXd position = Positions(state);
    const VectorXd velocity = Velocities(state);
    if (state.step != step_ || position != motion_.position ||
        velocity != motion_.velocity) {
      motion_ = StartMotion(system_, position, velocity);
    }
    StepReport report = Advance();
    if (!report.ok()) return report;
    Write(state);
    step_ = ++state.step;
    state.time.Add(time_step_);
    return report;
  }

 private:
  StepReport Advance() {
    switch (baseline_) {
      case Baseline::kNewmark:
        return StepGeneralizedAlpha(system_, time_step_,
                                    GeneralizedAlpha::AverageAcceleration(),
                                    &motion_);
      case Baseline::kMidpoint:
        return StepMidpoint(system_, time_step_, &motion_);
      case Baseline::kGeneralizedAlpha:
        return StepGeneralizedAlpha(
            system_, time_step_,
            GeneralizedAlpha::WithSpectralRadius(kBaselineSpectralRadius),
            &motion_);
      case Baseline::kVerlet:
        return StepVerlet(system_, time_step_, &motion_);
    }
    return {};
  }

  VectorXd Positions(const State& state) const {
    VectorXd q(system_.size());
    Eigen::Index i = 0;
    for (const VectorCoordinate& v : model_->vectors()) {
      q.segment<3>(3 * i++) =
          state.position.value.segment<3>(v.position_offset);
    }
    return q;
  }
  VectorXd Velocities(const State& state) const {
    VectorXd w(system_.size());
    Eigen::Index i = 0;
    for (const VectorCoordinate& v : model_->vectors()) {
      w.segment<3>(3 * i++) =
          state.velocity.value.segment<3>(v.velocity_offset);
    }
    return w;
  }

  void Write(State& state) const {
    Eigen::Index i = 0;
    for (const VectorCoordinate& v : model_->vectors()) {
      state.position.value.segment<3>(v.position_offset) =
          motion_.position.segment<3>(3 * i);
      state.velocity.value.segment<3>(v.velocity_offset) =
          motion_.velocity.segment<3>(3 * i);
      ++i;
    }
    const VectorXd strains = Strains(system_, motion_.position);
    Eigen::Index k = 0;
    for (const ModelBody& body : model_->bodies()) {
      state.strain.value.segment<AncfRigidBody::kNumStrains>(
          body.strain_offset) = strains.segment<AncfRigidBody::kNumStrains>(k);
      k += AncfRigidBody::kNumStrains;
    }
    for (const ModelLine& line : model_->lines()) {
      state.strain.value(line.strain_offset) = strains(k++);
    }
    state.position.compensation.setZero();
    state.velocity.compensation.setZero();
    state.strain.compensation.setZero();
  }

  const Model* model_;
  ElasticSystem system_;
  Baseline baseline_;
  double time_step_;
  Motion motion_;
  int64_t step_ = -1;
};

}  // namespace

const std::vector<Baseline>& AllBaselines() {
  static const std::vector<Baseline>* const all =
      new std::vector<Baseline>{Baseline::kNewmark, Baseline::kMidpoint,
                                Baseline::kGeneralizedAlpha, Baseline::kVerlet};
  return *all;
}

std::string BaselineName(Baseline baseline) {
  switch (baseline) {
    case Baseline::kNewmark:
      return "Newmark";
    case Baseline::kMidpoint:
      return "midpoint";
    case Baseline::kGeneralizedAlpha:
      return "generalised alpha";
    case Baseline::kVerlet:
      return "Verlet";
  }
  return "unknown";
}

Scheme BaselineScheme(Baseline baseline) {
  return [baseline](
             const Model& model,
             const IntegratorOptions& options) -> absl::StatusOr<StepFunction> {
    absl::StatusOr<ElasticSystem> system = SystemOfModel(model);
    if (!system.ok()) return system.status();
    const auto stepper = std::make_shared<Stepper>(model, *std::move(system),
                                                   baseline, options.time_step);
    return StepFunction(
        [stepper](State& state) { return stepper->Step(state); });
  };
}

}  // namespace emmy::verification
