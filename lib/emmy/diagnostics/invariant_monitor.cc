#include "emmy/diagnostics/invariant_monitor.h"

#include <algorithm>
#include <cmath>

#include "emmy/base/larger.h"

namespace emmy {
namespace {

// The norm where squares may overflow or vanish: scaled by a power of two,
// which changes no digit.
double SafeNorm(const DoubleDouble3& vector) {
  const double largest =
      vector.ToDouble().cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  if (!(largest > 0.0) || !std::isfinite(largest)) return largest;
  const int exponent = std::max(std::ilogb(largest), -1000);
  const DoubleDouble scale(std::ldexp(1.0, -exponent));
  return std::ldexp(Norm(scale * vector).ToDouble(), exponent);
}

void Record(const DoubleDouble3& initial, const DoubleDouble3& now,
            MomentumRecord* record) {
  record->final = now.ToDouble();
  record->max_error = Larger(record->max_error, SafeNorm(now - initial));
  record->scale = Larger(record->scale, SafeNorm(now));
}

}  // namespace

ConservedQuantities QuantitiesConservedBy(const Model& model) {
  const bool grounded =
      std::any_of(model.lines().begin(), model.lines().end(),
                  [](const ModelLine& line) {
                    return line.ends[0].is_ground() || line.ends[1].is_ground();
                  }) ||
      std::any_of(model.constraints().begin(), model.constraints().end(),
                  [](const ModelConstraint& c) { return c.to_ground; }) ||
      std::any_of(model.joints().begin(), model.joints().end(),
                  [](const ModelJoint& joint) { return joint.to_ground(); });
  const bool free =
      !grounded && model.gravity().isZero(0.0) && model.forces().empty();
  return {.energy = true,
          .momentum = free,
          .angular_momentum = free && model.torques().empty()};
}

InvariantMonitor::InvariantMonitor(const Model& model, const State& initial)
    : model_(&model), initial_(MeasureInvariants(model, initial)) {
  const ConservedQuantities conserved = QuantitiesConservedBy(model);
  energy_.conserved = conserved.energy;
  momentum_.conserved = conserved.momentum;
  angular_momentum_.conserved = conserved.angular_momentum;
  energy_.initial = initial_.TotalEnergy().ToDouble();
  momentum_.initial = initial_.momentum.ToDouble();
  angular_momentum_.initial = initial_.angular_momentum.ToDouble();
  Observe(initial);
}

void InvariantMonitor::Observe(const State& state) {
  Observe(MeasureInvariants(*model_, state));
}

void InvariantMonitor::Observe(const Invariants& measured) {
  latest_ = measured;
  const DoubleDouble total = latest_.TotalEnergy();
  energy_.final = total.ToDouble();
  energy_.max_error = Larger(
      energy_.max_error, std::abs((total - initial_.TotalEnergy()).ToDouble()));
  energy_.scale =
      Larger(energy_.scale, std::abs(latest_.InternalEnergy().ToDouble()));
  Record(initial_.momentum, latest_.momentum, &momentum_);
  Record(initial_.angular_momentum, latest_.angular_momentum,
         &angular_momentum_);
}

InvariantExtremes InvariantMonitor::extremes() const {
  return {.max_error = {energy_.max_error, momentum_.max_error,
                        angular_momentum_.max_error},
          .scale = {energy_.scale, momentum_.scale, angular_momentum_.scale}};
}

void InvariantMonitor::Resume(const State& state,
                              const InvariantExtremes& extremes) {
  energy_.max_error = extremes.max_error[0];
  energy_.scale = extremes.scale[0];
  momentum_.max_error = extremes.max_error[1];
  momentum_.scale = extremes.scale[1];
  angular_momentum_.max_error = extremes.max_error[2];
  angular_momentum_.scale = extremes.scale[2];
  Observe(state);
}

}  // namespace emmy
