// The step of one free ANCF body done right and, on purpose, wrong: what shows
// that a check of conservation can fail.

#ifndef EMMY_TESTS_SUPPORT_VARIANT_RUN_H_
#define EMMY_TESTS_SUPPORT_VARIANT_RUN_H_

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cstdint>
#include <ostream>

#include "emmy/diagnostics/invariants.h"
#include "emmy/element/ancf_rigid_body.h"
#include "emmy/integrate/ancf_body_step.h"
#include "emmy/model/model_builder.h"
#include "tests/support/paper_box.h"

namespace emmy {

enum class Variant {
  kRight,
  // State advanced by ordinary additions.
  kUncompensated,
  // Strain taken from the vectors after each step instead of carried.
  kRecomputedStrain,
  // Velocity from the rounded positions, w₁ = 2 (e₁ − e₀)/Δt − w₀.
  kPositionUnknown,
  // Stress at the end of the step instead of the mean.
  kEndPointStrain,
  // Mean strain, but the strain of the mean vectors.
  kStrainOfTheMean,
};

struct NamedVariant {
  Variant variant;
  const char* name;
  friend void PrintTo(const NamedVariant& v, std::ostream* os) {
    *os << v.name;
  }
};

class VariantRun {
 public:
  // The paper's box, turning only.
  VariantRun(Variant variant, const RigidBodyDescription& body,
             double time_step)
      : variant_(variant),
        time_step_(time_step),
        built_(BuildModel(ModelOf(body)).value()),
        element_(*built_.model.bodies()[0].ancf()),
        step_(element_, time_step, NewtonOptions{}) {}

  const Model& model() const { return built_.model; }
  const State& state() const { return built_.state; }
  DoubleDouble Energy() const {
    return MeasureInvariants(model(), state()).TotalEnergy();
  }

  bool Advance(int64_t num_steps) {
    for (int64_t i = 0; i < num_steps; ++i) {
      if (!Step()) {
        ADD_FAILURE() << "step " << i << " does not converge";
        return false;
      }
    }
    return true;
  }

 private:
  static Eigen::Map<Vector9d> Vectors(VectorXd& v) {
    return Eigen::Map<Vector9d>(v.data() + 3);
  }
  static Matrix3d Columns(const VectorXd& v) {
    return Eigen::Map<const Matrix3d>(v.data() + 3);
  }

  // Fixed-point iteration of (EM-2) with another strain in the stress: for
  // penalties so soft that the mass dominates.
  AncfBodyIncrement SolveWithWrongStrain(const AncfBodyStart& start) const {
    AncfBodyIncrement increment;
    for (int i = 0; i < 100; ++i) {
      increment.gradients =
          time_step_ *
          (start.rates + start.rates_compensation + 0.5 * increment.rates);
      const Matrix3d mean = start.gradients + start.gradients_compensation +
                            0.5 * increment.gradients;
      increment.strain =
          AncfRigidBody::StrainIncrement(mean, increment.gradients);
      const Vector6d strain = variant_ == Variant::kEndPointStrain
                                  ? Vector6d(start.strain + increment.strain)
                                  : AncfRigidBody::Strain(mean);
      increment.rates = -time_step_ * element_.InternalForce(mean, strain) *
                        element_.second_moment().inverse();
    }
    return increment;
  }

  bool Step() {
    State& state = built_.state;
    const AncfBodyStart start{
        .gradients = Columns(state.position.value),
        .gradients_compensation = Columns(state.position.compensation),
        .rates = Columns(state.velocity.value),
        .rates_compensation = Columns(state.velocity.compensation),
        .strain = state.strain.value,
        .strain_compensation = state.strain.compensation};
    AncfBodyIncrement increment;
    if (variant_ == Variant::kEndPointStrain ||
        variant_ == Variant::kStrainOfTheMean) {
      increment = SolveWithWrongStrain(start);
    } else if (step_.Solve(start, guess_, &increment).termination !=
               Termination::kConverged) {
      return false;
    }
    guess_ = increment.rates;
    const Eigen::Map<const Vector9d> gradients(increment.gradients.data());
    const Eigen::Map<const Vector9d> rates(increment.rates.data());
    if (variant_ == Variant::kUncompensated) {
      Vectors(state.position.value) += gradients;
      Vectors(state.velocity.value) += rates;
      state.strain.value += increment.strain;
      state.position.compensation.setZero();
      state.velocity.compensation.setZero();
      return true;
    }
    const Matrix3d before = Columns(state.position.value);
    state.position.Add(3, gradients);
    state.strain.Add(0, increment.strain);
    if (variant_ == Variant::kPositionUnknown) {
      const Matrix3d moved = Columns(state.position.value) - before;
      const Matrix3d velocity = (2.0 / time_step_) * moved - start.rates;
      Vectors(state.velocity.value) =
          Eigen::Map<const Vector9d>(velocity.data());
      state.velocity.compensation.setZero();
      return true;
    }
    state.velocity.Add(3, rates);
    if (variant_ == Variant::kRecomputedStrain) {
      state.strain.value = AncfRigidBody::Strain(Columns(state.position.value));
      state.strain.compensation.setZero();
    }
    return true;
  }

  Variant variant_;
  double time_step_;
  BuiltModel built_;
  AncfRigidBody element_;
  AncfBodyStep step_;
  Matrix3d guess_ = Matrix3d::Zero();
};

}  // namespace emmy

#endif  // EMMY_TESTS_SUPPORT_VARIANT_RUN_H_
