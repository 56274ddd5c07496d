// Emmy and the plain Runge-Kutta method behind the interface of the peers.

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "emmy/base/check.h"
#include "emmy/diagnostics/invariant_monitor.h"
#include "emmy/integrate/body_batch.h"
#include "emmy/integrate/energy_momentum.h"
#include "emmy/model/model_builder.h"
#include "verification/benchmarks/peers/peer_system.h"
#include "verification/benchmarks/runge_kutta_body.h"

namespace emmy::verification {
namespace {

class EmmySystem : public PeerSystem {
 public:
  explicit EmmySystem(BuiltModel built)
      : model_(std::move(built.model)), state_(std::move(built.state)) {
    IntegratorOptions options;
    options.time_step = kPeerTimeStep;
    absl::StatusOr<EnergyMomentumIntegrator> integrator =
        EnergyMomentumIntegrator::Create(model_, options);
    EMMY_CHECK(integrator.ok(), integrator.status().message());
    integrator_.emplace(*std::move(integrator));
    monitor_.emplace(model_, state_);
  }

  std::string Step() override {
    const StepReport report = integrator_->Step(state_);
    return report.ok() ? "" : report.message;
  }
  void Observe() override { monitor_->Observe(state_); }
  LawErrors Errors() const override {
    return {monitor_->energy().max_relative_error(),
            monitor_->angular_momentum().max_relative_error()};
  }
  std::string Settings() const override {
    return "order 2, iterated to round-off; energy with that of penalties";
  }

 private:
  const Model model_;
  State state_;
  std::optional<EnergyMomentumIntegrator> integrator_;
  std::optional<InvariantMonitor> monitor_;
};

// All bodies by SIMD in one thread.
class EmmyBatchSystem : public PeerSystem {
 public:
  explicit EmmyBatchSystem(BuiltModel built)
      : model_(std::move(built.model)), state_(std::move(built.state)) {
    absl::StatusOr<BodyBatch> batch =
        BodyBatch::Create(model_, {.time_step = kPeerTimeStep});
    EMMY_CHECK(batch.ok(), batch.status().message());
    batch_.emplace(*std::move(batch));
    batch_->Load(state_);
    monitor_.emplace(model_, state_);
  }

  std::string Step() override {
    const BatchReport report = batch_->Step(1);
    return report.ok() ? "" : report.failures[0].message;
  }
  void Observe() override {
    batch_->Store(&state_);
    monitor_->Observe(state_);
  }
  LawErrors Errors() const override {
    return {monitor_->energy().max_relative_error(),
            monitor_->angular_momentum().max_relative_error()};
  }
  std::string Settings() const override {
    return "order 2, iterated to round-off; a batch in SIMD lanes, one step a "
           "call, one thread";
  }

 private:
  const Model model_;
  State state_;
  std::optional<BodyBatch> batch_;
  std::optional<InvariantMonitor> monitor_;
};

class RungeKuttaSystem : public RigidSystem {
 public:
  explicit RungeKuttaSystem(const PeerCase& value)
      : RigidSystem(value),
        body_(Array(start()[0].inertia), Array(start()[0].angular_velocity)) {}

  std::string Step() override {
    body_.Step(kPeerTimeStep);
    return "";
  }
  std::string Settings() const override {
    return "Euler's equations and a quaternion, normalised in each step";
  }

 protected:
  std::vector<RigidMotion> Bodies() const override {
    std::vector<RigidMotion> result = start();
    const std::array<double, 4>& q = body_.quaternion();
    const std::array<double, 3>& omega = body_.angular_velocity();
    result[0].attitude =
        Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
    result[0].angular_velocity =
        result[0].attitude * Vector3d(omega[0], omega[1], omega[2]);
    return result;
  }

 private:
  static std::array<double, 3> Array(const Vector3d& v) {
    return {v(0), v(1), v(2)};
  }

  RungeKuttaBody body_;
};

}  // namespace

std::unique_ptr<PeerSystem> MakeEmmy(const ModelDescription& description) {
  absl::StatusOr<BuiltModel> built = BuildModel(description);
  EMMY_CHECK(built.ok(), built.status().message());
  return std::make_unique<EmmySystem>(*std::move(built));
}

std::unique_ptr<PeerSystem> MakeEmmyBatch(const ModelDescription& description) {
  absl::StatusOr<BuiltModel> built = BuildModel(description);
  EMMY_CHECK(built.ok(), built.status().message());
  return std::make_unique<EmmyBatchSystem>(*std::move(built));
}

std::unique_ptr<PeerSystem> MakeRungeKutta() {
  return std::make_unique<RungeKuttaSystem>(PeerBox());
}

}  // namespace emmy::verification
