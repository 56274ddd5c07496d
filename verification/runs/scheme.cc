#include "verification/runs/scheme.h"

#include <memory>
#include <utility>

#include "emmy/element/ancf_rigid_body.h"

namespace emmy::verification {

absl::StatusOr<StepFunction> EnergyMomentumScheme(
    const Model& model, const IntegratorOptions& options) {
  absl::StatusOr<EnergyMomentumIntegrator> integrator =
      EnergyMomentumIntegrator::Create(model, options);
  if (!integrator.ok()) return integrator.status();
  // Shared, because a std::function must be copyable.
  const auto shared =
      std::make_shared<EnergyMomentumIntegrator>(*std::move(integrator));
  return StepFunction([shared](State& state) { return shared->Step(state); });
}

absl::StatusOr<StepFunction> PlainArithmeticScheme(
    const Model& model, const IntegratorOptions& options) {
  absl::StatusOr<StepFunction> step = EnergyMomentumScheme(model, options);
  if (!step.ok()) return step.status();
  return StepFunction([step = *std::move(step), &model](State& state) {
    StepReport report = step(state);
    state.position.compensation.setZero();
    state.velocity.compensation.setZero();
    state.strain.compensation.setZero();
    for (const ModelBody& body : model.bodies()) {
      if (body.ancf() == nullptr) continue;
      const Matrix3d gradients = Eigen::Map<const Matrix3d>(
          state.position.value.data() + body.position_offset + 3);
      state.strain.value.segment<AncfRigidBody::kNumStrains>(
          body.strain_offset) = AncfRigidBody::Strain(gradients);
    }
    return report;
  });
}

}  // namespace emmy::verification
