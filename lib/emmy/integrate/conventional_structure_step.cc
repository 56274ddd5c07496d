#include "emmy/integrate/conventional_structure_step.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "emmy/numerics/rotation.h"
#include "emmy/numerics/unit_roundoff.h"

namespace emmy {
namespace {

// (1 − Hat(a))⁻¹ = (1 + a aᵀ + Hat(a)) / (1 + a·a).
Matrix3d InverseOneMinusHat(const Vector3d& a) {
  return (Matrix3d::Identity() + a * a.transpose() + Hat(a)) /
         (1.0 + a.squaredNorm());
}

}  // namespace

absl::StatusOr<std::optional<ConventionalStructureStep>>
ConventionalStructureStep::Create(const Model& model, double time_step,
                                  const NewtonOptions& options) {
  ConventionalStructureStep step(model, time_step, options);
  absl::Status status = step.Gather();
  if (!status.ok()) return status;
  if (step.bodies_.empty()) {
    return std::optional<ConventionalStructureStep>();
  }
  return std::optional<ConventionalStructureStep>(std::move(step));
}

int ConventionalStructureStep::LocalBody(size_t index) {
  int& local = local_body_[index];
  if (local < 0) {
    local = static_cast<int>(bodies_.size());
    Body& body = bodies_.emplace_back();
    body.index = index;
    body.body = &model_->bodies()[index];
    body.least_inertia =
        Eigen::SelfAdjointEigenSolver<Matrix3d>(
            body.body->conventional()->tensor(), Eigen::EigenvaluesOnly)
            .eigenvalues()(0);
  }
  return local;
}

absl::StatusOr<int> ConventionalStructureStep::LocalNode(int vector) {
  const auto v = static_cast<size_t>(vector);
  if (const ModelBody* const body = owner_[v]; body != nullptr) {
    return absl::UnimplementedError(absl::StrCat(
        "/rigid_bodies: body \"", body->name,
        "\" of formulation \"ancf\" is joined to a conventional body by "
        "trusses or springs; structures that mix the two are not supported "
        "yet"));
  }
  int& local = local_node_[v];
  if (local < 0) {
    local = static_cast<int>(nodes_.size());
    nodes_.emplace_back().vector = &model_->vectors()[v];
  }
  return local;
}

absl::StatusOr<ConventionalStructureStep::End>
ConventionalStructureStep::MakeEnd(const Point& point) {
  End end;
  if (point.conventional_body.has_value()) {
    end.body = LocalBody(*point.conventional_body);
    end.xi = point.xi;
  } else if (!point.terms.empty()) {
    absl::StatusOr<int> node = LocalNode(point.terms.front().vector);
    if (!node.ok()) return node.status();
    end.node = *node;
  } else {
    end.start = point.ground;
  }
  return end;
}

absl::Status ConventionalStructureStep::Gather() {
  local_body_.assign(model_->bodies().size(), -1);
  local_node_.assign(model_->vectors().size(), -1);
  owner_.assign(model_->vectors().size(), nullptr);
  for (const ModelBody& body : model_->bodies()) {
    if (body.ancf() == nullptr) continue;
    std::fill_n(owner_.begin() + body.first_vector, 4, &body);
  }
  absl::Status status = GatherLines();
  if (!status.ok()) return status;
  GatherMasses();
  status = GatherLoads();
  if (!status.ok()) return status;
  status = GatherJoints();
  if (!status.ok()) return status;
  for (VectorXd* v : {&unknown_, &residual_, &magnitude_, &correction_}) {
    v->setZero(3 * static_cast<Index>(NumBlocks()));
  }
  // Up to here a dense factor costs less than to look after a sparse one.
  constexpr int kLargestDense = 16;
  if (joints_.empty() && NumBlocks() <= kLargestDense) {
    tangent_.MakeDense(NumBlocks());
  } else {
    MakePattern();
  }
  return absl::OkStatus();
}

// Lines at conventional bodies, then all that hang together with them.
absl::Status ConventionalStructureStep::GatherLines() {
  std::vector<std::vector<size_t>> at_vector(model_->vectors().size());
  std::vector<size_t> found;
  for (size_t i = 0; i < model_->lines().size(); ++i) {
    const ModelLine& line = model_->lines()[i];
    if (line.has_conventional_end()) found.push_back(i);
    for (const Point& end : line.ends) {
      for (const WeightedVector& term : end.terms) {
        at_vector[static_cast<size_t>(term.vector)].push_back(i);
      }
    }
  }
  std::vector<bool> taken(model_->lines().size(), false);
  for (size_t next = 0; next < found.size(); ++next) {
    const size_t i = found[next];
    if (taken[i]) continue;
    taken[i] = true;
    const ModelLine& line = model_->lines()[i];
    Line& local = lines_.emplace_back();
    local.line = &line;
    for (size_t e = 0; e < 2; ++e) {
      absl::StatusOr<End> end = MakeEnd(line.ends[e]);
      if (!end.ok()) return end.status();
      local.ends[e] = *end;
      local.ends[e].velocity_offset = line.end_velocity_offset[e];
      for (const WeightedVector& term : line.ends[e].terms) {
        std::vector<size_t>& others =
            at_vector[static_cast<size_t>(term.vector)];
        found.insert(found.end(), others.begin(), others.end());
        others.clear();  // Once, or a hub would cost the square of its lines.
      }
    }
  }
  return absl::OkStatus();
}

void ConventionalStructureStep::GatherMasses() {
  for (size_t v = 0; v < model_->mass().size(); ++v) {
    if (local_node_[v] < 0) continue;
    for (const MassEntry& entry : model_->mass()[v]) {
      masses_.push_back({local_node_[v],
                         local_node_[static_cast<size_t>(entry.column)],
                         entry.mass});
    }
  }
}

absl::Status ConventionalStructureStep::GatherLoads() {
  for (const ModelForce& force : model_->forces()) {
    const bool at_node =
        !force.point.terms.empty() &&
        local_node_[static_cast<size_t>(force.point.terms.front().vector)] >= 0;
    if (!force.point.conventional_body.has_value() && !at_node) continue;
    absl::StatusOr<End> end = MakeEnd(force.point);
    if (!end.ok()) return end.status();
    forces_.push_back({*end, force.force});
  }
  for (const ModelTorque& torque : model_->torques()) {
    if (model_->bodies()[torque.body].conventional() == nullptr) continue;
    torques_.push_back({LocalBody(torque.body), torque.torque});
  }
  return absl::OkStatus();
}

void ConventionalStructureStep::LoadEnd(const State& state, End* end) const {
  if (end->body >= 0) {
    const Body& body = bodies_[static_cast<size_t>(end->body)];
    end->start = body.x0;
    end->rest = body.x0_compensation;
  } else if (end->node >= 0) {
    const Node& node = nodes_[static_cast<size_t>(end->node)];
    end->start = node.q0;
    end->rest = node.q0_compensation;
  } else {
    end->rest.setZero();
  }
  if (end->velocity_offset >= 0) {
    end->v0 = state.end_velocity.value.segment<3>(end->velocity_offset);
    end->v0_compensation =
        state.end_velocity.compensation.segment<3>(end->velocity_offset);
  }
}

void ConventionalStructureStep::Load(const State& state) {
  for (size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    const Index q = body.body->position_offset;
    const Index w = body.body->velocity_offset;
    body.x0 = state.position.value.segment<3>(q);
    body.x0_compensation = state.position.compensation.segment<3>(q);
    body.quaternion = state.position.value.segment<4>(q + 3);
    body.rotation =
        QuaternionToMatrix(Vector4d(state.position.value.segment<4>(q + 3)));
    body.v0 = state.velocity.value.segment<3>(w);
    body.v0_compensation = state.velocity.compensation.segment<3>(w);
    body.w0 = state.velocity.value.segment<3>(w + 3);
    body.w0_compensation = state.velocity.compensation.segment<3>(w + 3);
    unknown_.segment<6>(BodyRow(static_cast<int>(i))) =
        time_step_ * state.acceleration.next.segment<6>(w);
  }
  for (size_t i = 0; i < nodes_.size(); ++i) {
    Node& node = nodes_[i];
    const auto [q, w, moment] = *node.vector;
    node.q0 = state.position.value.segment<3>(q);
    node.q0_compensation = state.position.compensation.segment<3>(q);
    node.w0 = state.velocity.value.segment<3>(w);
    node.w0_compensation = state.velocity.compensation.segment<3>(w);
    unknown_.segment<3>(NodeRow(static_cast<int>(i))) =
        time_step_ * state.acceleration.next.segment<3>(w);
  }
  for (Line& line : lines_) {
    line.strain = state.strain.value(line.line->strain_offset);
    line.strain_compensation =
        state.strain.compensation(line.line->strain_offset);
    for (End& end : line.ends) LoadEnd(state, &end);
  }
  for (Force& force : forces_) LoadEnd(state, &force.end);
  LoadJoints(state);
}

void ConventionalStructureStep::EvaluateBody(size_t index) {
  Body& body = bodies_[index];
  const Index row = BodyRow(static_cast<int>(index));
  const Vector3d dv = unknown_.segment<3>(row);
  const Vector3d dw = unknown_.segment<3>(row + 3);
  body.mean_velocity = body.v0 + (body.v0_compensation + 0.5 * dv);
  body.mean_omega = body.w0 + (body.w0_compensation + 0.5 * dw);
  body.increment = time_step_ * body.mean_velocity;
  const Vector3d half_turn = (0.5 * time_step_) * body.mean_omega;
  body.mean_rotation = body.rotation * InverseOneMinusHat(half_turn);
  body.inverse_mean_rotation =
      (Matrix3d::Identity() - Hat(half_turn)) * body.rotation.transpose();
  body.torque.setZero();
  const ConventionalRigidBody& element = *body.body->conventional();
  const Vector3d inertial = element.mass() * dv;
  const Vector3d weight = (time_step_ * element.mass()) * model_->gravity();
  const Vector3d spin = element.tensor() * dw;
  const Vector3d gyroscopic =
      time_step_ * body.mean_omega.cross(element.tensor() * body.mean_omega);
  residual_.segment<3>(row) = inertial - weight;
  residual_.segment<3>(row + 3) = spin + gyroscopic;
  // By terms: the sums may cancel, their rounding does not.
  magnitude_.segment<3>(row) = inertial.cwiseAbs() + weight.cwiseAbs();
  magnitude_.segment<3>(row + 3) = spin.cwiseAbs() + gyroscopic.cwiseAbs();
}

void ConventionalStructureStep::EvaluateEnd(End* end) const {
  if (end->body >= 0) {
    const Body& body = bodies_[static_cast<size_t>(end->body)];
    end->arm = body.mean_rotation * end->xi;
    end->mean_rate =
        body.mean_velocity + (body.rotation * body.mean_omega).cross(end->arm);
    end->increment = time_step_ * end->mean_rate;
  } else if (end->node >= 0) {
    const Node& node = nodes_[static_cast<size_t>(end->node)];
    end->arm.setZero();
    end->mean_rate = node.mean_rate;
    end->increment = node.increment;
    end->rate_increment = unknown_.segment<3>(NodeRow(end->node));
  } else {
    end->arm.setZero();
    end->mean_rate.setZero();
    end->increment.setZero();
    end->rate_increment.setZero();
  }
  if (end->velocity_offset >= 0) {
    end->rate_increment =
        2.0 * ((end->mean_rate - end->v0) - end->v0_compensation);
  }
}

void ConventionalStructureStep::AddImpulse(const End& end,
                                           const Vector3d& impulse) {
  const double size = impulse.cwiseAbs().maxCoeff();
  if (end.body >= 0) {
    const Index row = BodyRow(end.body);
    residual_.segment<3>(row) += impulse;
    magnitude_.segment<3>(row).array() += size;
    magnitude_.segment<3>(row + 3).array() += size * end.arm.norm();
    bodies_[static_cast<size_t>(end.body)].torque += end.arm.cross(impulse);
  } else if (end.node >= 0) {
    residual_.segment<3>(NodeRow(end.node)) += impulse;
    magnitude_.segment<3>(NodeRow(end.node)).array() += size;
  }
}

void ConventionalStructureStep::EvaluateLine(Line* line) {
  auto& [first, second] = line->ends;
  for (End& end : line->ends) EvaluateEnd(&end);
  // Means of x̄ + R ξ: the arm is already R̄ ξ, so that only x̄ moves on.
  const auto travel = [this](const End& end) -> Vector3d {
    if (end.body >= 0) {
      return 0.5 * bodies_[static_cast<size_t>(end.body)].increment;
    }
    return 0.5 * end.increment;
  };
  line->mean = (second.start - first.start) +
               ((second.arm - first.arm) + ((second.rest - first.rest) +
                                            (travel(second) - travel(first))));
  const Vector3d change = second.increment - first.increment;
  line->response = line->line->element.Respond(
      line->strain, line->strain_compensation, line->mean.dot(change));
  const Vector3d force =
      (time_step_ * line->response.tension_factor) * line->mean;
  AddImpulse(first, -force);
  AddImpulse(second, force);
  const double mass = line->line->mass;
  if (mass == 0.0 || !line->line->has_conventional_end()) return;
  for (size_t e = 0; e < 2; ++e) {
    const End& end = line->ends[e];
    const End& other = line->ends[1 - e];
    Vector3d momentum = (mass / 6.0) * other.rate_increment;
    if (end.body >= 0) {
      momentum += (mass / 3.0) * end.rate_increment -
                  (0.5 * mass * time_step_) * model_->gravity();
    }
    AddImpulse(end, momentum);
  }
}

void ConventionalStructureStep::Evaluate() {
  magnitude_.setZero();
  for (size_t i = 0; i < nodes_.size(); ++i) {
    Node& node = nodes_[i];
    const Index row = NodeRow(static_cast<int>(i));
    node.mean_rate =
        node.w0 + (node.w0_compensation + 0.5 * unknown_.segment<3>(row));
    node.increment = time_step_ * node.mean_rate;
    residual_.segment<3>(row) =
        -(time_step_ * node.vector->first_moment) * model_->gravity();
    magnitude_.segment<3>(row) = residual_.segment<3>(row).cwiseAbs();
  }
  for (const Mass& mass : masses_) {
    const Vector3d momentum =
        mass.mass * unknown_.segment<3>(NodeRow(mass.column));
    residual_.segment<3>(NodeRow(mass.row)) += momentum;
    magnitude_.segment<3>(NodeRow(mass.row)) += momentum.cwiseAbs();
  }
  for (size_t i = 0; i < bodies_.size(); ++i) EvaluateBody(i);
  for (Line& line : lines_) EvaluateLine(&line);
  for (Force& force : forces_) {
    EvaluateEnd(&force.end);
    AddImpulse(force.end, -time_step_ * force.force);
  }
  EvaluateJoints();
  for (const Torque& torque : torques_) {
    bodies_[static_cast<size_t>(torque.body)].torque -=
        time_step_ * torque.torque;
  }
  for (size_t i = 0; i < bodies_.size(); ++i) {
    residual_.segment<3>(BodyRow(static_cast<int>(i)) + 3) +=
        bodies_[i].inverse_mean_rotation * bodies_[i].torque;
  }
}

// Adds (∂Δx_first)ᵀ S (∂Δx_second) / (¼ Δt²), with the body's rows in its axes.
void ConventionalStructureStep::AddToTangent(const End& first,
                                             const End& second,
                                             const Matrix3d& stiffness) {
  const auto blocks = [this](const End& end) {
    // First block, their number, and the 3 × n matrix of ∂v_c.
    Eigen::Matrix<double, 3, 6> map = Eigen::Matrix<double, 3, 6>::Zero();
    map.leftCols<3>().setIdentity();
    if (end.body >= 0) {
      const Body& body = bodies_[static_cast<size_t>(end.body)];
      map.rightCols<3>() = -Hat(end.arm) * body.rotation;
      return std::make_pair(std::make_pair(BodyBlock(end.body), 2), map);
    }
    const int size = end.node >= 0 ? 1 : 0;
    return std::make_pair(std::make_pair(NodeBlock(end.node), size), map);
  };
  const auto [rows, left] = blocks(first);
  const auto [columns, right] = blocks(second);
  if (rows.second == 0 || columns.second == 0) return;
  const Eigen::Matrix<double, 6, 6> product =
      left.transpose() * stiffness * right;
  for (int r = 0; r < rows.second; ++r) {
    for (int c = 0; c < columns.second; ++c) {
      tangent_.Add(rows.first + r, columns.first + c,
                   product.block<3, 3>(3 * Index{r}, 3 * Index{c}));
    }
  }
}

bool ConventionalStructureStep::FormTangent() {
  tangent_.SetZero();
  for (size_t i = 0; i < bodies_.size(); ++i) {
    const int row = BodyBlock(static_cast<int>(i));
    const ConventionalRigidBody& element = *bodies_[i].body->conventional();
    const Vector3d momentum = element.tensor() * bodies_[i].mean_omega;
    tangent_.Add(row, row, element.mass() * Matrix3d::Identity());
    tangent_.Add(
        row + 1, row + 1,
        element.tensor() + (0.5 * time_step_) *
                               (Hat(bodies_[i].mean_omega) * element.tensor() -
                                Hat(momentum)));
  }
  for (const Mass& mass : masses_) {
    tangent_.Add(NodeBlock(mass.row), NodeBlock(mass.column),
                 mass.mass * Matrix3d::Identity());
  }
  const double quarter = 0.25 * time_step_ * time_step_;
  for (const Line& line : lines_) {
    const Vector3d& d = line.mean;
    const Matrix3d stiffness =
        quarter * (line.response.tension_factor * Matrix3d::Identity() +
                   2.0 * line.response.derivative * d * d.transpose());
    for (size_t a = 0; a < 2; ++a) {
      for (size_t b = 0; b < 2; ++b) {
        AddToTangent(line.ends[a], line.ends[b],
                     a == b ? stiffness : Matrix3d(-stiffness));
        if (!line.line->has_conventional_end()) continue;
        if (a == b && line.ends[a].body < 0) continue;  // In masses_.
        const double mass = line.line->mass / (a == b ? 3.0 : 6.0);
        AddToTangent(line.ends[a], line.ends[b], mass * Matrix3d::Identity());
      }
    }
  }
  AddJointsToTangent();
  return tangent_.Factorize();
}

// What rounding may do: the largest rate, with that of the start, as w₀ and ½Δw
// may cancel; and by each term's size, that of the work and of the moment.
ConventionalStructureStep::Scale ConventionalStructureStep::Scales() const {
  Scale scale;
  const auto add = [&scale](double magnitude, double arm, double rate) {
    const double squared = magnitude * magnitude;
    scale.work += squared * (rate * rate);
    scale.moment += squared * (arm * arm);
  };
  const auto largest = [](const Vector3d& v) {
    return v.cwiseAbs().maxCoeff();
  };
  for (size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    const Index row = BodyRow(static_cast<int>(i));
    add(magnitude_.segment<3>(row).norm(),
        body.x0.norm() + 0.5 * body.increment.norm(),
        body.mean_velocity.norm());
    add(magnitude_.segment<3>(row + 3).norm(), 1.0, body.mean_omega.norm());
    scale.rate =
        std::max({scale.rate, largest(body.v0), largest(body.mean_velocity),
                  largest(body.w0), largest(body.mean_omega)});
    // What the rounding of a joint's rate may do to W.
    if (!joints_.empty()) {
      scale.rate =
          std::max(scale.rate, 0.5 * body.mean_velocity.norm() / body.gyration);
    }
  }
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    add(magnitude_.segment<3>(NodeRow(static_cast<int>(i))).norm(),
        node.q0.norm() + 0.5 * node.increment.norm(), node.mean_rate.norm());
    scale.rate =
        std::max({scale.rate, largest(node.w0), largest(node.mean_rate)});
  }
  scale.work = std::sqrt(scale.work);
  scale.moment = std::sqrt(scale.moment);
  return scale;
}

// The largest correction of a rate, where the rounding of impulses on a light
// body between heavy ones moves it by more than that of the model's `rate`
// does: its correction counts by the share that `rate` is of its own.
double ConventionalStructureStep::LargestCorrection(double rate) const {
  double result = correction_.segment(NodeRow(0), JointRow(0) - NodeRow(0))
                      .lpNorm<Eigen::Infinity>();
  for (size_t i = 0; i < bodies_.size(); ++i) {
    const Index row = BodyRow(static_cast<int>(i));
    const auto add = [&](Index at, double mass) {
      const double own = magnitude_.segment<3>(at).maxCoeff() / mass;
      const double size = correction_.segment<3>(at).cwiseAbs().maxCoeff();
      result = std::max(result, own > rate ? size * (rate / own) : size);
    };
    add(row, bodies_[i].body->conventional()->mass());
    add(row + 3, bodies_[i].least_inertia);
  }
  return result;
}

// Σ r·w̄, which is the energy a residual puts in (EM-7); what joints that do not
// close add is not in it (CONJ-3).
double ConventionalStructureStep::Work() const {
  double work = 0.0;
  for (size_t i = 0; i < bodies_.size(); ++i) {
    const Index row = BodyRow(static_cast<int>(i));
    work += bodies_[i].mean_velocity.dot(residual_.segment<3>(row)) +
            bodies_[i].mean_omega.dot(residual_.segment<3>(row + 3));
  }
  for (size_t i = 0; i < nodes_.size(); ++i) {
    work += nodes_[i].mean_rate.dot(
        residual_.segment<3>(NodeRow(static_cast<int>(i))));
  }
  return work;
}

// The net moment of the residual about the origin.
Vector3d ConventionalStructureStep::Moment() const {
  Vector3d moment = Vector3d::Zero();
  for (size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    const Index row = BodyRow(static_cast<int>(i));
    const Vector3d centre = body.x0 + 0.5 * body.increment;
    moment += centre.cross(residual_.segment<3>(row)) +
              body.mean_rotation * residual_.segment<3>(row + 3);
  }
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    const Vector3d position = node.q0 + 0.5 * node.increment;
    moment +=
        position.cross(residual_.segment<3>(NodeRow(static_cast<int>(i))));
  }
  return moment;
}

BodyStepResult ConventionalStructureStep::Iterate(bool damped) {
  BodyStepResult result;
  StagnationMonitor rate_monitor;
  StagnationMonitor work_monitor;
  StagnationMonitor moment_monitor;
  double previous = std::numeric_limits<double>::infinity();
  int settled = 0;
  int noise = 0;
  constexpr int kNoisePatience = 3;  // Iterations, of which none was better.
  // One that still shrinks is not begun again: it goes on, for as many
  // iterations as new attempts would take.
  constexpr int kAttempts = 3;
  for (int i = 1; i <= kAttempts * options_.max_iterations; ++i) {
    if (i > options_.max_iterations && !(result.correction < previous)) break;
    result.iterations = i;
    Evaluate();
    // Anew in every step, since the effective masses turn with the bodies;
    // and within a step where it no longer serves.
    constexpr double kSlow = 0.3;
    const bool renew = i == 1 || damped || result.correction > kSlow * previous;
    if (renew && !FormTangent()) {
      result.termination = Termination::kSingularTangent;
      return result;
    }
    previous = i == 1 ? previous : result.correction;
    const Scale scale = Scales();
    const double work = std::abs(Work());
    const double moment = Moment().cwiseAbs().maxCoeff();
    tangent_.Solve(residual_, &correction_);
    if (damped) LimitTurns();
    unknown_ -= correction_;
    result.correction = correction_.head(JointRow(0))
                            .cwiseAbs()
                            .maxCoeff<Eigen::PropagateNaN>();
    if (!std::isfinite(result.correction) ||
        !correction_.tail(correction_.size() - JointRow(0)).allFinite()) {
      result.termination = Termination::kNonFinite;
      return result;
    }
    if (options_.tolerance.has_value()) {
      if (result.correction <= *options_.tolerance * scale.rate) {
        result.termination = Termination::kConverged;
        return result;
      }
      continue;
    }
    const bool rate_done = rate_monitor.Update(
        result.correction, 4.0 * kUnitRoundoff * scale.rate);
    const bool work_done =
        work_monitor.Update(work, kUnitRoundoff * scale.work);
    const bool moment_done =
        moment_monitor.Update(moment, kUnitRoundoff * scale.moment);
    if (rate_done) ++settled;
    // By this iterate, and not by different ones.
    const bool laws_hold =
        work_done && moment_done &&
        work <= kNearLawFloor * kUnitRoundoff * scale.work &&
        moment <= kNearLawFloor * kUnitRoundoff * scale.moment;
    const bool is_noise = laws_hold && LargestCorrection(scale.rate) <=
                                           4.0 * kUnitRoundoff * scale.rate;
    noise = is_noise ? noise + 1 : 0;
    if ((rate_done && (laws_hold || settled > kStagnationPatience)) ||
        noise > kNoisePatience) {
      result.termination = Termination::kConverged;
      return result;
    }
  }
  return result;
}

// An iterate that has run away is none.
BodyStepResult ConventionalStructureStep::IterateAndCheck(bool damped) {
  BodyStepResult result = Iterate(damped);
  Evaluate();
  if (result.termination == Termination::kConverged && !KeepsEnergy()) {
    result.termination = Termination::kMaxIterations;
  }
  return result;
}

BodyStepResult ConventionalStructureStep::Solve(const State& state) {
  Load(state);
  BodyStepResult result = IterateAndCheck(/*damped=*/false);
  // Once more from rest, and with joints a third time in small turns.
  for (const bool damped : {false, true}) {
    if (result.termination == Termination::kConverged) break;
    if (damped && joints_.empty()) break;
    const int iterations = result.iterations;
    unknown_.setZero();
    result = IterateAndCheck(damped);
    result.iterations += iterations;
  }
  open_joint_ = nullptr;
  if (result.termination == Termination::kConverged) {
    open_joint_ = OpenJoint();
    if (open_joint_ != nullptr) {
      result.termination = Termination::kSingularTangent;
    }
  }
  return result;
}

std::string ConventionalStructureStep::WorstPart() const {
  if (open_joint_ != nullptr) {
    return absl::StrCat(open_joint_->name,
                        ", which opens where other shared points held it at "
                        "the start");
  }
  size_t worst = 0;
  double largest = -1.0;
  for (size_t i = 0; i < bodies_.size(); ++i) {
    const double size =
        residual_.segment<6>(BodyRow(static_cast<int>(i))).norm();
    // The first that is not finite is worse than any other.
    if (size <= largest) continue;
    worst = i;
    largest = size;
    if (!std::isfinite(size)) break;
  }
  return absl::StrCat("the structure of body \"", bodies_[worst].body->name,
                      "\"");
}

void ConventionalStructureStep::Commit(State& state) const {
  double work = 0.0;
  for (const Force& force : forces_) {
    work += force.force.dot(force.end.increment);
  }
  for (const Torque& torque : torques_) {
    const Body& body = bodies_[static_cast<size_t>(torque.body)];
    work += time_step_ * torque.torque.dot(body.rotation * body.mean_omega);
  }
  state.load_work.Add(work);
  Extrapolation::Errors errors{};
  for (size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    const Index q = body.body->position_offset;
    const Index w = body.body->velocity_offset;
    const auto change = unknown_.segment<6>(BodyRow(static_cast<int>(i)));
    state.position.Add(q, body.increment);
    state.position.Add(q + 3,
                       CayleyQuaternionIncrement(body.quaternion,
                                                 time_step_ * body.mean_omega));
    state.velocity.Add(w, change);
    state.acceleration.Add(w, change / time_step_, &errors);
  }
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const auto [q, w, moment] = *nodes_[i].vector;
    const auto change = unknown_.segment<3>(NodeRow(static_cast<int>(i)));
    state.position.Add(q, nodes_[i].increment);
    state.velocity.Add(w, change);
    state.acceleration.Add(w, change / time_step_, &errors);
  }
  const int order = Extrapolation::BestOrder(errors);
  for (const Body& body : bodies_) {
    state.acceleration.Predict(body.body->velocity_offset, 6, order);
  }
  for (const Node& node : nodes_) {
    state.acceleration.Predict(node.vector->velocity_offset, 3, order);
  }
  for (const Line& line : lines_) {
    const Index s = line.line->strain_offset;
    AddCompensated(line.response.increment, state.strain.value(s),
                   state.strain.compensation(s));
    for (const End& end : line.ends) {
      if (end.velocity_offset >= 0) {
        state.end_velocity.Add(end.velocity_offset, end.rate_increment);
      }
    }
  }
  CommitJoints(state);
}

}  // namespace emmy
