#include "emmy/integrate/coupled_step.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "absl/strings/str_cat.h"
#include "emmy/integrate/exact_tangent.h"
#include "emmy/numerics/rotation.h"
#include "emmy/numerics/unit_roundoff.h"

namespace emmy {
namespace {

// One, or where the structure is large up to one a block.
size_t NumThreads(const Structure& structure, int wanted) {
  const size_t blocks = VectorBlocks(structure.num_vectors()).count();
  return std::clamp<size_t>(static_cast<size_t>(wanted), 1,
                            std::max<size_t>(blocks, 1));
}

// NaN if any entry is.
double MaxAbs(const Matrix3Xd& m) {
  return m.size() > 0 ? m.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() : 0.0;
}

}  // namespace

CoupledStep::CoupledStep(const Structure& structure, double time_step,
                         const CoupledStepOptions& options)
    : structure_(&structure),
      time_step_(time_step),
      options_(options),
      tangent_(structure, time_step, options.method),
      team_(std::make_unique<WorkTeam>(
          NumThreads(structure, options.num_threads))),
      masses_(structure.num_vectors()),
      lines_(structure) {
  const Eigen::Index vectors = structure.num_vectors();
  const Eigen::Index constraints = structure.num_constraints();
  const auto strains =
      static_cast<Eigen::Index>(structure.strain_offsets.size());
  for (Matrix3Xd* m :
       {&q0_, &q0_compensation_, &w0_, &w0_compensation_, &dw_, &mean_rate_,
        &dq_, &mean_, &end_, &residual_, &correction_}) {
    m->setZero(3, vectors);
  }
  magnitude_.setZero(vectors);
  for (Matrix3Xd* m : {&impulse_, &constraint_rate_, &impulse_correction_}) {
    m->setZero(3, constraints);
  }
  for (VectorXd* v : {&strain0_, &strain0_compensation_, &strain_increment_}) {
    v->setZero(strains);
  }
  for (const Structure::Mass& mass : structure.masses) {
    masses_.Add(mass, mass.row, mass.column);
  }
  if (!options.always_factorize && LinedBodyLanes::Fits(structure)) {
    lanes_.emplace(structure, time_step, options.newton);
  }
}

// Calls work(v) for every vector, by all threads.
template <typename Work>
void CoupledStep::ForVectors(const Work& work) {
  team_->Run(static_cast<size_t>(structure_->num_vectors()),
             [&work](size_t /*member*/, size_t first, size_t end) {
               for (size_t v = first; v < end; ++v) {
                 work(static_cast<Eigen::Index>(v));
               }
             });
}

// Of a constraint's force in the state.
Eigen::Index CoupledStep::MultiplierOffset(Eigen::Index constraint) const {
  return 3 *
         static_cast<Eigen::Index>(
             structure_->constraints[static_cast<size_t>(constraint)].index);
}

void CoupledStep::Load(const State& state) {
  for (Eigen::Index v = 0; v < structure_->num_vectors(); ++v) {
    const auto [q, w, moment] = structure_->vectors[static_cast<size_t>(v)];
    q0_.col(v) = state.position.value.segment<3>(q);
    q0_compensation_.col(v) = state.position.compensation.segment<3>(q);
    w0_.col(v) = state.velocity.value.segment<3>(w);
    w0_compensation_.col(v) = state.velocity.compensation.segment<3>(w);
    dw_.col(v) = time_step_ * state.acceleration.next.segment<3>(w);
  }
  for (Eigen::Index s = 0; s < strain0_.size(); ++s) {
    const Eigen::Index offset =
        structure_->strain_offsets[static_cast<size_t>(s)];
    strain0_(s) = state.strain.value(offset);
    strain0_compensation_(s) = state.strain.compensation(offset);
  }
  for (Eigen::Index c = 0; c < structure_->num_constraints(); ++c) {
    impulse_.col(c) =
        time_step_ * state.multiplier.next.segment<3>(MultiplierOffset(c));
  }
  lines_.Load(q0_, q0_compensation_);
}

void CoupledStep::EvaluateBodies() {
  for (const Structure::Body& body : structure_->bodies) {
    const AncfRigidBody& ancf = *body.body->ancf();
    const Matrix3d mean = mean_.middleCols<3>(body.first + 1);
    const Matrix3d increment = dq_.middleCols<3>(body.first + 1);
    const Vector6d strain_increment =
        AncfRigidBody::StrainIncrement(mean, increment);
    strain_increment_.segment<6>(body.first_strain) = strain_increment;
    const Vector6d mean_strain =
        strain0_.segment<6>(body.first_strain) +
        (strain0_compensation_.segment<6>(body.first_strain) +
         0.5 * strain_increment);
    const Matrix3d impulse = time_step_ * ancf.InternalForce(mean, mean_strain);
    residual_.middleCols<3>(body.first + 1) += impulse;
    magnitude_.segment<3>(body.first + 1) +=
        impulse.cwiseAbs().colwise().maxCoeff().transpose();
  }
}

void CoupledStep::EvaluateLoads() {
  for (const Structure::Force& force : structure_->forces) {
    for (const WeightedVector& term : force.terms) {
      residual_.col(term.vector) -= (time_step_ * term.weight) * force.force;
    }
  }
  for (const Structure::Torque& torque : structure_->torques) {
    const Matrix3d duals =
        mean_.middleCols<3>(torque.first + 1).inverse().transpose();
    for (int i = 0; i < 3; ++i) {
      residual_.col(torque.first + 1 + i) -=
          (0.5 * time_step_) * torque.torque.cross(duals.col(i));
    }
  }
}

void CoupledStep::EvaluateConstraints() {
  for (size_t i = 0; i < structure_->constraints.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const Vector3d impulse = impulse_.col(column);
    const double size = impulse.cwiseAbs().maxCoeff();
    Vector3d rate = Vector3d::Zero();
    Vector3d rest = Vector3d::Zero();
    for (const WeightedVector& term : structure_->constraints[i].terms) {
      residual_.col(term.vector) += term.weight * impulse;
      magnitude_(term.vector) += std::abs(term.weight) * size;
      rate += term.weight * w0_.col(term.vector);
      rest += term.weight *
              (w0_compensation_.col(term.vector) + 0.5 * dw_.col(term.vector));
    }
    constraint_rate_.col(column) = rate + rest;
  }
}

// M Δw
void CoupledStep::EvaluateInertia() {
  const auto add = [this](const Structure::Mass& entry) {
    const auto& [row, column, mass] = entry;
    residual_.col(row) += mass * dw_.col(column);
    if (row != column) residual_.col(column) += mass * dw_.col(row);
  };
  masses_.ForBlocks(team_.get(), add);
  for (const Structure::Mass& entry : masses_.rest()) add(entry);
}

// (EM-1) and the residual of (EM-9) at Δw and Δt λ.
void CoupledStep::Evaluate() {
  // In one pass: of a large net every array is read from memory.
  ForVectors([this](Eigen::Index v) {
    mean_rate_.col(v) =
        w0_.col(v) + (w0_compensation_.col(v) + 0.5 * dw_.col(v));
    dq_.col(v) = time_step_ * mean_rate_.col(v);
    mean_.col(v) = q0_.col(v) + (q0_compensation_.col(v) + 0.5 * dq_.col(v));
    residual_.col(v).setZero();
  });
  EvaluateInertia();
  // By terms: inertia and weight may cancel, their rounding does not.
  ForVectors([this](Eigen::Index v) {
    magnitude_(v) = residual_.col(v).cwiseAbs().maxCoeff();
    residual_.col(v) -= time_step_ * structure_->gravity_force.col(v);
  });
  EvaluateBodies();
  lines_.AddImpulses(time_step_, dq_, strain0_, strain0_compensation_,
                     team_.get(), &residual_, &magnitude_);
  EvaluateLoads();
  EvaluateConstraints();
}

CoupledStep::Floors CoupledStep::RoundingFloors() const {
  // By terms here too: where a motion turns back, w₀ and ½ Δw cancel.
  const double rate = std::max(MaxAbs(w0_), MaxAbs(mean_rate_));
  double force = 0.0;
  double moment = 0.0;
  double work = 0.0;
  // Independent roundings add as the root of the sum of squares.
  for (Eigen::Index v = 0; v < magnitude_.size(); ++v) {
    const double size = magnitude_(v) * magnitude_(v);
    force += size;
    moment += size * mean_.col(v).squaredNorm();
    work += size * mean_rate_.col(v).squaredNorm();
  }
  // A strain increment is rounded by about u |q̄| |Δq|, which a correction of
  // 4 u |w| undoes.
  return {4.0 * kUnitRoundoff * rate, kUnitRoundoff * std::sqrt(force),
          kUnitRoundoff * std::sqrt(moment), kUnitRoundoff * std::sqrt(work)};
}

bool CoupledStep::Restore(const KeptTangent& kept) {
  renew_ = true;
  if (kept.matrix.size() == 0) return true;
  if (!tangent_.Restore(kept)) return false;
  renew_ = false;
  return true;
}

// Strain increments of the lines; those of the bodies come with Evaluate.
void CoupledStep::AdvanceLines() {
  lines_.AdvanceStrains(dq_, strain0_, strain0_compensation_, team_.get(),
                        &strain_increment_);
}

bool CoupledStep::Renew() {
  renew_ = false;
  lines_.Respond(dq_, strain0_, strain0_compensation_);
  return tangent_.Factorize(Point());
}

// Solves (EM-10), or with the exact Jacobian; false if singular.
bool CoupledStep::SolveCorrection(bool exact) {
  constraint_rate_ *= 2.0;
  if (!exact) {
    tangent_.Solve(residual_, constraint_rate_, &correction_,
                   &impulse_correction_, team_.get());
    return true;
  }
  AdvanceLines();
  lines_.Respond(dq_, strain0_, strain0_compensation_);
  const VectorXd mean_strain =
      strain0_ + (strain0_compensation_ + 0.5 * strain_increment_);
  return SolveExactTangent(
      *structure_, time_step_,
      {mean_, end_, mean_strain, lines_.mean(), lines_.End(dq_),
       lines_.tension(), lines_.derivative()},
      residual_, constraint_rate_, &correction_, &impulse_correction_);
}

// What the energy may change by: the residual's work (EM-7), and that of the
// joint forces where the points they join do not yet move alike.
double CoupledStep::ResidualWork() const {
  return std::abs(mean_rate_.cwiseProduct(residual_).sum()) +
         std::abs(impulse_.cwiseProduct(constraint_rate_).sum());
}

CoupledStep::Laws CoupledStep::MeasureLaws() const {
  Vector3d force = Vector3d::Zero();
  Vector3d moment = Vector3d::Zero();
  for (Eigen::Index v = 0; v < residual_.cols(); ++v) {
    if (structure_->translates[static_cast<size_t>(v)]) {
      force += residual_.col(v);
    }
    moment += mean_.col(v).cross(residual_.col(v));
  }
  return {force.cwiseAbs().maxCoeff(), moment.cwiseAbs().maxCoeff(),
          ResidualWork()};
}

// Whether the laws hold for the last Δw itself. Each was judged before the last
// correction, and perhaps by different iterates, which noise in the corrections
// takes back and forth.
bool CoupledStep::LawsHold() const {
  constexpr double kLawFloors = 8.0;
  const Laws laws = MeasureLaws();
  const Floors floors = RoundingFloors();
  return (structure_->is_grounded ||
          (laws.force <= kLawFloors * floors.force &&
           laws.moment <= kLawFloors * floors.moment)) &&
         laws.work <= kLawFloors * floors.work;
}

// From `near` the solution, gives up soon if it does not get there.
BodyStepResult CoupledStep::Iterate(bool exact, bool near) {
  BodyStepResult result;
  // What the laws forbid to remain is judged apart from the corrections: the
  // net force, the net moment and the work of the residual (EM-7).
  StagnationMonitor rate_monitor(kNegligibleRest, /*explains_rounding=*/true);
  StagnationMonitor force_monitor = StagnationMonitor::OfLaw();
  StagnationMonitor moment_monitor = StagnationMonitor::OfLaw();
  StagnationMonitor work_monitor = StagnationMonitor::OfLaw();
  double previous = std::numeric_limits<double>::infinity();
  int slow = 0;
  int settled = 0;
  bool renewed = false;
  for (int i = 1; i <= options_.newton.max_iterations; ++i) {
    result.iterations = i;
    Evaluate();
    if (exact || !structure_->bodies.empty()) {
      end_.noalias() = mean_ + 0.5 * dq_;
    }
    if (!exact) {
      tangent_.FollowBodies(mean_, end_);
      // A small factor costs less than the iterations it saves.
      const bool cheap =
          i == 1 && tangent_.method() == SymmetricFactor::Method::kDense;
      if (renew_ || cheap || options_.always_factorize) {
        renewed = true;
        if (!Renew()) {
          result.termination = Termination::kSingularTangent;
          return result;
        }
      } else if (i == 1) {
        tangent_.FollowStructure(mean_);
      }
    }
    const Laws laws = MeasureLaws();
    const Floors floors = RoundingFloors();

    if (!SolveCorrection(exact)) {
      result.termination = Termination::kSingularTangent;
      return result;
    }
    ForVectors([this](Eigen::Index v) { dw_.col(v) -= correction_.col(v); });
    impulse_ -= impulse_correction_;
    result.correction = MaxAbs(correction_);
    // An iterate that has run away can make corrections vanish: what it is
    // judged by must be finite as well.
    if (!std::isfinite(result.correction) || !std::isfinite(laws.work) ||
        !std::isfinite(floors.work) || !std::isfinite(floors.force) ||
        !std::isfinite(floors.moment) || !residual_.allFinite()) {
      result.termination = Termination::kNonFinite;
      return result;
    }
    if (options_.newton.tolerance.has_value()) {
      if (result.correction <=
          *options_.newton.tolerance * MaxAbs(mean_rate_)) {
        result.termination = Termination::kConverged;
        return result;
      }
    } else {
      const bool rate_done =
          rate_monitor.Update(result.correction, floors.rate);
      // Held by the ground, net force and moment carry the rounding of stiff
      // elements, and no law asks them to vanish.
      const bool force_done = structure_->is_grounded ||
                              force_monitor.Update(laws.force, floors.force);
      const bool moment_done =
          structure_->is_grounded ||
          moment_monitor.Update(laws.moment, floors.moment);
      const bool work_done = work_monitor.Update(laws.work, floors.work);
      if (rate_done) ++settled;
      const bool laws_done = force_done && moment_done && work_done;
      const bool impatient = settled > kStagnationPatience;
      if (impatient && !laws_done && !exact) return result;  // kMaxIterations
      if (rate_done && (laws_done || impatient)) {
        // Slow: renewed before the next step, where it costs no iteration.
        constexpr int kManyIterations = 12;
        if (i > kManyIterations || slow > 1) renew_ = true;
        result.termination = Termination::kConverged;
        return result;
      }
    }
    constexpr double kSlow = 0.5;
    const bool far = result.correction > 1e3 * floors.rate;
    // Newton's method takes three iterations, unless cables go slack and taut.
    constexpr int kFinish = 5;
    if (near && far && i >= kFinish) return result;
    if (far && i > 1 && result.correction > kSlow * previous) {
      ++slow;
      if (!renewed || slow > 3) {
        renew_ = true;
        slow = 0;
      }
    }
    previous = result.correction;
  }
  return result;
}

// Δw of a rigid turn of the whole by the Cayley map of Δt ω about its centre
// of mass: no strain, whatever the step.                            (EM-8)
void CoupledStep::GuessRigidTurn() {
  double mass = 0.0;
  Vector3d centre = Vector3d::Zero();
  Vector3d velocity = Vector3d::Zero();
  for (Eigen::Index v = 0; v < q0_.cols(); ++v) {
    const double moment =
        structure_->vectors[static_cast<size_t>(v)].first_moment;
    mass += moment;
    centre += moment * q0_.col(v);
    velocity += moment * w0_.col(v);
  }
  centre /= mass;
  velocity /= mass;
  const auto translates = [this](int v) {
    return structure_->translates[static_cast<size_t>(v)] ? 1.0 : 0.0;
  };
  const auto arm = [&](int v) -> Vector3d {
    return q0_.col(v) - translates(v) * centre;
  };
  const auto rate = [&](int v) -> Vector3d {
    return w0_.col(v) - translates(v) * velocity;
  };
  Vector3d momentum = Vector3d::Zero();
  Matrix3d inertia = Matrix3d::Zero();
  const auto add = [&](int a, int b, double m) {
    momentum += m * arm(a).cross(rate(b));
    inertia += m * (arm(a).dot(arm(b)) * Matrix3d::Identity() -
                    arm(a) * arm(b).transpose());
  };
  for (const Structure::Mass& entry : structure_->masses) {
    add(entry.row, entry.column, entry.mass);
    if (entry.row != entry.column) add(entry.column, entry.row, entry.mass);
  }
  // A single point has no inertia to turn with.
  const Eigen::ColPivHouseholderQR<Matrix3d> solver(inertia);
  const Vector3d omega = solver.isInvertible()
                             ? Vector3d(solver.solve(momentum))
                             : Vector3d(Vector3d::Zero());
  const Matrix3d turn = CayleyRotation(time_step_ * omega);
  for (int v = 0; v < structure_->num_vectors(); ++v) {
    dw_.col(v) = 2.0 * ((turn * arm(v) - arm(v)) / time_step_ - rate(v));
  }
}

// Whether what the energy may change by (ResidualWork) is small against the
// energy of the start. An iterate that has run away is solved to the round-off
// of its own size, which may be more than all the energy there is.
bool CoupledStep::KeepsEnergy() const {
  if (options_.newton.tolerance.has_value()) return true;
  double energy = 0.0;
  for (const Structure::Mass& mass : structure_->masses) {
    const double product =
        mass.mass * w0_.col(mass.row).dot(w0_.col(mass.column));
    energy += mass.row == mass.column ? 0.5 * product : product;
  }
  for (const Structure::Body& body : structure_->bodies) {
    energy += body.body->ancf()->PenaltyEnergy(
        strain0_.segment<6>(body.first_strain));
  }
  for (const Structure::Line& line : structure_->lines) {
    energy += line.line->element.Energy(strain0_(line.strain)).ToDouble();
  }
  // Loads may do more work in a step than there is energy to start with.
  const double load_work =
      (structure_->gravity_force.cwiseAbs().cwiseProduct(dq_.cwiseAbs()))
          .sum() +
      std::abs(LoadWork());
  return ResidualWork() <= kLargestShare * (energy + load_work);
}

BodyStepResult CoupledStep::IterateAndCheck(bool exact, bool near) {
  BodyStepResult result = Iterate(exact, near);
  Evaluate();  // Δq and Δε of the final Δw.
  AdvanceLines();
  if (result.termination == Termination::kConverged &&
      (!KeepsEnergy() ||
       (!exact && !options_.newton.tolerance.has_value() && !LawsHold()))) {
    result.termination = Termination::kMaxIterations;
  }
  return result;
}

// With the kept tangent, and from where that leads with the exact Jacobian if
// it is near but slow, or cannot bring the laws to their floors.
BodyStepResult CoupledStep::IterateAndFinish() {
  constexpr double kNear = 1e-6;
  BodyStepResult result = IterateAndCheck(/*exact=*/false);
  if (result.termination != Termination::kMaxIterations ||
      !(result.correction <=
        kNear * std::max(MaxAbs(w0_), MaxAbs(mean_rate_)))) {
    return result;
  }
  const int iterations = result.iterations;
  result = IterateAndCheck(/*exact=*/true, /*near=*/true);
  result.iterations += iterations;
  return result;
}

BodyStepResult CoupledStep::Solve(const State& state) {
  BodyStepResult result;
  if (lanes_.has_value()) {
    result = lanes_->Solve(state, &dw_, &dq_, &strain_increment_);
    if (result.termination == Termination::kConverged) return result;
  }
  int iterations = result.iterations;
  Load(state);
  result = IterateAndFinish();
  iterations += result.iterations;
  // Once more from a start without strain, then with the exact Jacobian.
  for (const bool exact : {false, true}) {
    if (result.termination == Termination::kConverged) break;
    Load(state);
    GuessRigidTurn();
    renew_ = true;
    result = exact ? IterateAndCheck(/*exact=*/true) : IterateAndFinish();
    iterations += result.iterations;
  }
  result.iterations = iterations;
  if (result.termination != Termination::kConverged) renew_ = true;
  return result;
}

// Work of the loads along the last solution [J].
double CoupledStep::LoadWork() const {
  double work = 0.0;
  for (const Structure::Force& force : structure_->forces) {
    for (const WeightedVector& term : force.terms) {
      work += term.weight * force.force.dot(dq_.col(term.vector));
    }
  }
  for (const Structure::Torque& torque : structure_->torques) {
    const Matrix3d duals =
        mean_.middleCols<3>(torque.first + 1).inverse().transpose();
    for (int i = 0; i < 3; ++i) {
      work +=
          0.5 *
          torque.torque.cross(duals.col(i)).dot(dq_.col(torque.first + 1 + i));
    }
  }
  return work;
}

void CoupledStep::Commit(State& state) const {
  state.load_work.Add(LoadWork());
  Extrapolation::Errors errors{};
  for (Eigen::Index v = 0; v < structure_->num_vectors(); ++v) {
    const auto [q, w, moment] = structure_->vectors[static_cast<size_t>(v)];
    state.position.Add(q, dq_.col(v));
    state.velocity.Add(w, dw_.col(v));
    state.acceleration.Add(w, dw_.col(v) / time_step_, &errors);
  }
  const int order = Extrapolation::BestOrder(errors);
  for (const VectorCoordinate& vector : structure_->vectors) {
    state.acceleration.Predict(vector.velocity_offset, 3, order);
  }
  for (Eigen::Index s = 0; s < strain_increment_.size(); ++s) {
    const Eigen::Index offset =
        structure_->strain_offsets[static_cast<size_t>(s)];
    AddCompensated(strain_increment_(s), state.strain.value(offset),
                   state.strain.compensation(offset));
  }
  Extrapolation::Errors multiplier_errors{};
  for (Eigen::Index c = 0; c < structure_->num_constraints(); ++c) {
    state.multiplier.Add(MultiplierOffset(c), impulse_.col(c) / time_step_,
                         &multiplier_errors);
  }
  const int multiplier_order = Extrapolation::BestOrder(multiplier_errors);
  for (Eigen::Index c = 0; c < structure_->num_constraints(); ++c) {
    state.multiplier.Predict(MultiplierOffset(c), 3, multiplier_order);
  }
}

std::string CoupledStep::WorstPart() const {
  Eigen::Index worst = 0;
  residual_.cwiseAbs().colwise().maxCoeff().maxCoeff(&worst);
  for (const Structure::Body& body : structure_->bodies) {
    if (worst >= body.first && worst < body.first + 4) {
      return absl::StrCat("body \"", body.body->name, "\"");
    }
  }
  for (const Structure::Line& line : structure_->lines) {
    for (const WeightedVector& term : line.terms) {
      if (term.vector == worst) {
        return absl::StrCat("an end of \"", line.line->name, "\"");
      }
    }
  }
  return "a node";
}

}  // namespace emmy
