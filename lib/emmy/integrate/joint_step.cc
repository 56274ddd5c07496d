#include "emmy/integrate/joint_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "emmy/integrate/joint_chain.h"
#include "emmy/integrate/joint_graph.h"
#include "emmy/integrate/joint_net.h"
#include "emmy/integrate/joint_system.h"
#include "emmy/numerics/unit_roundoff.h"

namespace emmy {
namespace {

// What a factorisation costs, in iterations: 12 for a grid of 30 × 30 boxes, 20
// for one of 100 × 100.
constexpr int64_t kFactorization = 16;

// The sizes of rounding from the first iterate that is nearly right, and now
// and then.
ForwardWork WorkOf(int iteration) {
  constexpr int kSizesEvery = 4;
  if (iteration == 1) return ForwardWork::kFactorize;
  return iteration % kSizesEvery == 2 ? ForwardWork::kSizes
                                      : ForwardWork::kResidual;
}

// A body couples each of its joints with each other: a net whose couplings are
// many times its joints, as of a thousand bodies on one plate, is better solved
// by all coordinates.
bool HasCrowdedBodies(const Structure& structure,
                      const std::vector<BodyJoint>& joints) {
  constexpr int64_t kLargestMean = 64;
  std::vector<int64_t> at_body(structure.bodies.size(), 0);
  for (const BodyJoint& joint : joints) {
    for (const int body : joint.bodies) {
      if (body >= 0) ++at_body[static_cast<size_t>(body)];
    }
  }
  int64_t couplings = 0;
  for (const int64_t count : at_body) couplings += count * count;
  return couplings > kLargestMean * static_cast<int64_t>(joints.size());
}

double MaxAbs(const Vector3d& v) { return v.cwiseAbs().maxCoeff(); }

}  // namespace

std::unique_ptr<JointStep> JointStep::Create(const Structure& structure,
                                             double time_step,
                                             const CoupledStepOptions& options,
                                             int num_threads) {
  if (options.always_factorize ||
      options.method != SymmetricFactor::Method::kAutomatic) {
    return nullptr;
  }
  const std::vector<BodyJoint> joints = FindBodyJoints(structure);
  if (joints.empty() || HasCrowdedBodies(structure, joints)) return nullptr;
  const std::optional<BodyRow> row = FindBodyRow(structure, joints);
  std::unique_ptr<JointSystem> system;
  if (row.has_value()) {
    system = std::make_unique<JointChain>(structure, joints, *row, time_step,
                                          num_threads);
  } else {
    system = std::make_unique<JointNet>(structure, joints, time_step);
  }
  return std::unique_ptr<JointStep>(
      new JointStep(structure, time_step, options, std::move(system)));
}

JointStep::JointStep(const Structure& structure, double time_step,
                     const CoupledStepOptions& options,
                     std::unique_ptr<JointSystem> system)
    : structure_(&structure),
      time_step_(time_step),
      options_(options),
      system_(std::move(system)) {}

JointStep::~JointStep() = default;

BodyStepResult JointStep::Iterate() {
  BodyStepResult result;
  // As in CoupledStep, but for the floors, which are those of some iterations
  // before, and the end: what has not settled is begun again by CoupledStep.
  StagnationMonitor rate_monitor;
  StagnationMonitor force_monitor = StagnationMonitor::OfLaw();
  StagnationMonitor moment_monitor = StagnationMonitor::OfLaw();
  StagnationMonitor work_monitor = StagnationMonitor::OfLaw();
  double previous = std::numeric_limits<double>::infinity();
  int slow = 0;
  int settled = 0;
  for (int i = 1; i <= options_.newton.max_iterations; ++i) {
    result.iterations = i;
    const JointSums& sums = system_->Evaluate(WorkOf(i));
    const double rate_floor = 4.0 * kUnitRoundoff * sums.rate;
    const double residual_work = std::abs(sums.work);
    // Whether more iterations follow is guessed by the last step: of effect on
    // time alone.
    const JointCorrection correction = system_->Correct(
        i < last_iterations_ ? std::optional(WorkOf(i + 1)) : std::nullopt);
    result.correction = correction.largest;
    if (!correction.is_finite || !std::isfinite(sums.work) ||
        !std::isfinite(sums.work_size) || !std::isfinite(sums.moment_size) ||
        !sums.force.allFinite() || !sums.moment.allFinite()) {
      result.termination = Termination::kNonFinite;
      return result;
    }
    if (options_.newton.tolerance.has_value()) {
      if (result.correction <= *options_.newton.tolerance * sums.rate) {
        result.termination = Termination::kConverged;
        return result;
      }
    } else {
      const bool rate_done = rate_monitor.Update(result.correction, rate_floor);
      const bool force_done =
          structure_->is_grounded ||
          force_monitor.Update(MaxAbs(sums.force),
                               kUnitRoundoff * std::sqrt(sums.force_size));
      const bool moment_done =
          structure_->is_grounded ||
          moment_monitor.Update(MaxAbs(sums.moment),
                                kUnitRoundoff * std::sqrt(sums.moment_size));
      const bool work_done = work_monitor.Update(
          residual_work, kUnitRoundoff * std::sqrt(sums.work_size));
      if (rate_done) ++settled;
      const bool laws_done = force_done && moment_done && work_done;
      if (settled > kStagnationPatience && !laws_done) return result;
      if (rate_done && laws_done) {
        // An iterate that has run away, see CoupledStep.
        if (residual_work <= kLargestShare * (sums.energy + sums.load_work)) {
          result.termination = Termination::kConverged;
        }
        return result;
      }
    }
    constexpr double kSlow = 0.5;
    const bool far = result.correction > 1e3 * rate_floor;
    if (far && i > 1 && result.correction > kSlow * previous &&
        !system_->Renew() && ++slow > 2) {
      return result;
    }
    previous = result.correction;
  }
  return result;
}

// A kept matrix fits less and less as the bodies turn against each other. It is
// made anew when the iterations this has cost are as much work as that.
void JointStep::Age(int iterations, bool is_fresh) {
  if (is_fresh) {
    fewest_iterations_ = iterations;
    excess_iterations_ = 0;
    return;
  }
  // A step that makes one in its course has needed many before that.
  fewest_iterations_ = std::min<int64_t>(fewest_iterations_, iterations);
  excess_iterations_ += iterations - fewest_iterations_;
  if (excess_iterations_ >= kFactorization) system_->Renew();
}

BodyStepResult JointStep::Solve(const State& state) {
  const int factorizations = system_->num_factorizations();
  system_->Load(state);
  BodyStepResult result = Iterate();
  last_iterations_ = result.iterations;
  used_coupled_ = result.termination != Termination::kConverged;
  if (!used_coupled_) {
    Age(result.iterations, system_->num_factorizations() != factorizations);
    return result;
  }
  // A matrix made in an iteration that failed would not do for the next.
  system_->Forget();
  fewest_iterations_ = 0;
  excess_iterations_ = 0;
  if (coupled_ == nullptr) {
    coupled_ = std::make_unique<CoupledStep>(*structure_, time_step_, options_);
  }
  // Nothing kept, so that a resumed run repeats every bit.
  static_cast<void>(coupled_->Restore({}));
  const int iterations = result.iterations;
  result = coupled_->Solve(state);
  result.iterations += iterations;
  return result;
}

void JointStep::Commit(State& state) {
  if (used_coupled_) {
    coupled_->Commit(state);
  } else {
    system_->Commit(state);
  }
}

std::string JointStep::WorstPart() const { return coupled_->WorstPart(); }

KeptTangent JointStep::Keep() const {
  KeptTangent kept = system_->Keep();
  kept.fewest_iterations = fewest_iterations_;
  kept.excess_iterations = excess_iterations_;
  return kept;
}

bool JointStep::Restore(const KeptTangent& kept) {
  fewest_iterations_ = kept.fewest_iterations;
  excess_iterations_ = kept.excess_iterations;
  return system_->Restore(kept);
}

int JointStep::num_factorizations() const {
  return system_->num_factorizations() +
         (coupled_ == nullptr ? 0 : coupled_->num_factorizations());
}

}  // namespace emmy
