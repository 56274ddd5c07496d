#include "emmy/model/model_assembler.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "emmy/model/constraint_rank.h"
#include "emmy/model/joint_rank.h"
#include "emmy/model/rigid_body_assembly.h"
#include "emmy/model/validation.h"
#include "emmy/numerics/rotation.h"

namespace emmy {
namespace {

// Shared points must agree to this share of the model's size and speed: far
// above the rounding of given decimals, far below any wrong number.
constexpr double kAgreement = 1e-9;

std::string Item(std::string_view list, size_t index) {
  return absl::StrCat("/", std::string(list), "/", index);
}

void Append(const VectorXd& part, VectorXd* whole) {
  const Eigen::Index offset = whole->size();
  whole->conservativeResize(offset + part.size());
  whole->segment(offset, part.size()) = part;
}

// R of a conventional body, by columns.
std::array<DoubleDouble3, 3> BodyFrame(const State& state,
                                       const ModelBody& body) {
  std::array<DoubleDouble, 4> quaternion;
  for (size_t i = 0; i < 4; ++i) {
    const auto row = body.position_offset + 3 + static_cast<Eigen::Index>(i);
    quaternion[i] = {state.position.value(row),
                     state.position.compensation(row)};
  }
  return QuaternionToMatrix(quaternion);
}

// R ξ of a conventional body.
DoubleDouble3 BodyArm(const State& state, const ModelBody& body,
                      const Vector3d& xi) {
  const std::array<DoubleDouble3, 3> frame = BodyFrame(state, body);
  return DoubleDouble(xi(0)) * frame[0] + DoubleDouble(xi(1)) * frame[1] +
         DoubleDouble(xi(2)) * frame[2];
}

bool IsGround(const ResolvedPoint& point) {
  return std::holds_alternative<ResolvedGround>(point);
}

}  // namespace

absl::StatusOr<BuiltModel> ModelAssembler::Assemble() && {
  using Part = absl::Status (ModelAssembler::*)();
  for (const Part part :
       {&ModelAssembler::AddGravity, &ModelAssembler::AddBodies,
        &ModelAssembler::ReadNodes, &ModelAssembler::TieSharedPoints,
        &ModelAssembler::AddNodes, &ModelAssembler::AddConstraints,
        &ModelAssembler::AddTrusses, &ModelAssembler::AddSprings,
        &ModelAssembler::AddLoads}) {
    absl::Status status = (this->*part)();
    if (!status.ok()) return status;
  }
  absl::Status status = CheckMasses();
  if (!status.ok()) return status;
  for (const std::map<int, double>& row : mass_) {
    std::vector<MassEntry>& entries = model_.mass_.emplace_back();
    for (const auto& [column, mass] : row) entries.push_back({column, mass});
  }
  state_.end_velocity.compensation.setZero(model_.num_end_velocities_);
  state_.acceleration.SetZero(model_.num_velocities_);
  state_.multiplier.SetZero(model_.num_multipliers());
  return BuiltModel{std::move(model_), std::move(state_)};
}

absl::Status ModelAssembler::AddName(const std::string& pointer,
                                     const std::string& name,
                                     NamedItem::Kind kind, size_t index) {
  if (name.empty()) {
    return FieldError(pointer + "/name", "a name that is not empty", "\"\"");
  }
  // Names head the columns of tables, and stand in messages of one line.
  if (!IsPrintable(name)) {
    return FieldError(pointer + "/name", "a name without control characters",
                      NameText(name));
  }
  const auto [place, is_new] = items_.emplace(
      name, NamedItem{.kind = kind, .index = index, .pointer = pointer});
  if (is_new) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(pointer, "/name: must be unique, got \"", name,
                   "\", which is the name of ", place->second.pointer));
}

absl::Status ModelAssembler::AddGravity() {
  model_.gravity_ = description_.gravity;
  if (description_.rigid_bodies.empty() && description_.nodes.empty()) {
    return absl::InvalidArgumentError(
        "/rigid_bodies: must hold at least one body, or /nodes one node, got "
        "none");
  }
  return CheckFinite("/gravity", description_.gravity, "m/s^2");
}

absl::Status ModelAssembler::AddBodies() {
  // Sizes first, so that each state vector is allocated once.
  std::vector<AssembledRigidBody> parts;
  parts.reserve(description_.rigid_bodies.size());
  for (size_t i = 0; i < description_.rigid_bodies.size(); ++i) {
    const RigidBodyDescription& body = description_.rigid_bodies[i];
    const std::string pointer = Item("rigid_bodies", i);
    absl::Status status =
        AddName(pointer, body.name, NamedItem::Kind::kBody, i);
    if (!status.ok()) return status;
    absl::StatusOr<AssembledRigidBody> part = AssembleRigidBody(pointer, body);
    if (!part.ok()) return part.status();
    parts.push_back(*std::move(part));
    model_.bodies_.push_back({.name = body.name,
                              .element = parts.back().element,
                              .position_offset = model_.num_positions_,
                              .velocity_offset = model_.num_velocities_,
                              .strain_offset = model_.num_strains_});
    model_.num_positions_ += parts.back().position.size();
    model_.num_velocities_ += parts.back().velocity.size();
    model_.num_strains_ += parts.back().strain.size();
  }
  state_.position.SetZero(model_.num_positions_);
  state_.velocity.SetZero(model_.num_velocities_);
  state_.strain.SetZero(model_.num_strains_);
  for (size_t i = 0; i < parts.size(); ++i) {
    const AssembledRigidBody& part = parts[i];
    ModelBody& body = model_.bodies_[i];
    const Eigen::Index q = body.position_offset;
    const Eigen::Index w = body.velocity_offset;
    state_.position.value.segment(q, part.position.size()) = part.position;
    state_.position.compensation.segment(q, part.position.size()) =
        part.position_compensation;
    state_.velocity.value.segment(w, part.velocity.size()) = part.velocity;
    state_.velocity.compensation.segment(w, part.velocity.size()) =
        part.velocity_compensation;
    state_.strain.value.segment(body.strain_offset, part.strain.size()) =
        part.strain;
    body_omega_.push_back(part.angular_velocity);
    if (body.ancf() == nullptr) continue;
    body.first_vector = static_cast<int>(model_.vectors_.size());
    const Matrix3d& moment = body.ancf()->second_moment();
    for (int a = 0; a < 4; ++a) {
      model_.vectors_.push_back(
          {q + 3 * a, w + 3 * a, a == 0 ? body.ancf()->mass() : 0.0});
      std::map<int, double>& row = mass_.emplace_back();
      if (a == 0) {
        row[body.first_vector] = body.ancf()->mass();
        continue;
      }
      for (int b = 1; b < 4; ++b) {
        const double entry = moment(a - 1, b - 1);
        if (entry != 0.0) row[body.first_vector + b] = entry;
      }
    }
  }
  return absl::OkStatus();
}

absl::StatusOr<Vector3d> ModelAssembler::StartVelocity(
    const std::string& pointer, const NodeDescription& node) const {
  if (const auto* given = std::get_if<Vector3d>(&node.velocity)) {
    absl::Status status = CheckFinite(pointer + "/velocity", *given, "m/s");
    if (!status.ok()) return status;
    return *given;
  }
  const std::string& name = std::get<MovesWith>(node.velocity).body;
  const auto item = items_.find(name);
  if (item == items_.end() || item->second.kind != NamedItem::Kind::kBody) {
    return FieldError(pointer + "/velocity/moves_with",
                      "the name of a rigid body", NameText(name));
  }
  const size_t index = item->second.index;
  const ModelBody& body = model_.bodies_[index];
  const Vector3d arm =
      node.position - state_.position.value.segment<3>(body.position_offset);
  return (state_.velocity.value.segment<3>(body.velocity_offset) +
          body_omega_[index].cross(arm))
      .eval();
}

absl::Status ModelAssembler::ReadNodes() {
  ties_ = NodeTies(description_.nodes.size());
  for (size_t i = 0; i < description_.nodes.size(); ++i) {
    const NodeDescription& node = description_.nodes[i];
    const std::string pointer = Item("nodes", i);
    absl::Status status =
        AddName(pointer, node.name, NamedItem::Kind::kNode, i);
    if (!status.ok()) return status;
    status = CheckNotNegative(pointer + "/mass", node.mass, "kg");
    if (!status.ok()) return status;
    status = CheckMass(pointer + "/mass", node.mass);
    if (!status.ok()) return status;
    status = CheckFinite(pointer + "/position", node.position, "m");
    if (!status.ok()) return status;
    absl::StatusOr<Vector3d> velocity = StartVelocity(pointer, node);
    if (!velocity.ok()) return velocity.status();
    if (node.fixed) {
      if (!velocity->isZero(0.0)) {
        return FieldError(pointer + "/velocity", "zero for a fixed node [m/s]",
                          absl::StrFormat("[%g, %g, %g]", (*velocity)(0),
                                          (*velocity)(1), (*velocity)(2)));
      }
      ties_.Tie(ResolvedNode{i}, ResolvedGround{node.position}, pointer);
    }
    node_velocity_.push_back(*velocity);
  }
  return absl::OkStatus();
}

absl::StatusOr<ResolvedPoint> ModelAssembler::Resolve(
    const std::string& pointer, const PointDescription& point) const {
  if (const auto* ground = std::get_if<GroundPoint>(&point)) {
    absl::Status status =
        CheckFinite(pointer + "/ground", ground->position, "m");
    if (!status.ok()) return status;
    return ResolvedGround{ground->position};
  }
  if (const auto* node = std::get_if<NodePoint>(&point)) {
    const auto item = items_.find(node->node);
    if (item == items_.end() || item->second.kind != NamedItem::Kind::kNode) {
      return FieldError(pointer + "/node", "the name of a node",
                        NameText(node->node));
    }
    return ResolvedNode{item->second.index};
  }
  const auto& body = std::get<BodyPoint>(point);
  const auto item = items_.find(body.body);
  if (item == items_.end() || item->second.kind != NamedItem::Kind::kBody) {
    return FieldError(pointer + "/body", "the name of a rigid body",
                      NameText(body.body));
  }
  absl::Status status = CheckFinite(pointer + "/point", body.point, "m");
  if (!status.ok()) return status;
  return ResolvedBodyPoint{item->second.index, body.point};
}

absl::Status ModelAssembler::TieSharedPoints() {
  MeasureModel();
  for (size_t i = 0; i < description_.shared_points.size(); ++i) {
    const std::string pointer = Item("shared_points", i);
    const auto& pair = description_.shared_points[i];
    const absl::StatusOr<ResolvedPoint> first =
        Resolve(pointer + "/0", pair[0]);
    if (!first.ok()) return first.status();
    const absl::StatusOr<ResolvedPoint> second =
        Resolve(pointer + "/1", pair[1]);
    if (!second.ok()) return second.status();
    absl::Status status =
        CheckTogether(pointer, MotionOf(*first), MotionOf(*second));
    if (!status.ok()) return status;
    ties_.Tie(*first, *second, pointer);
  }
  return absl::OkStatus();
}

int ModelAssembler::AddVector(const Vector3d& position,
                              const Vector3d& velocity) {
  model_.vectors_.push_back(
      {model_.num_positions_, model_.num_velocities_, 0.0});
  mass_.emplace_back();
  state_.position.value.segment<3>(model_.num_positions_) = position;
  state_.velocity.value.segment<3>(model_.num_velocities_) = velocity;
  model_.num_positions_ += 3;
  model_.num_velocities_ += 3;
  return static_cast<int>(model_.vectors_.size()) - 1;
}

absl::Status ModelAssembler::AddNodes() {
  const size_t num_nodes = description_.nodes.size();
  vector_of_node_.assign(num_nodes, -1);
  // Room for every node; cut to what is free below.
  const auto room = static_cast<Eigen::Index>(3 * num_nodes);
  const VectorXd zeros = VectorXd::Zero(room);
  for (VectorXd* vector :
       {&state_.position.value, &state_.position.compensation,
        &state_.velocity.value, &state_.velocity.compensation}) {
    Append(zeros, vector);
  }
  for (size_t i = 0; i < num_nodes; ++i) {
    if (ties_.Representative(i) == i && !ties_.Anchor(i).has_value()) {
      vector_of_node_[i] =
          AddVector(description_.nodes[i].position, node_velocity_[i]);
    }
  }
  for (CompensatedVector* vector : {&state_.position, &state_.velocity}) {
    const Eigen::Index size = vector == &state_.position
                                  ? model_.num_positions_
                                  : model_.num_velocities_;
    vector->value.conservativeResize(size);
    vector->compensation.conservativeResize(size);
  }
  for (size_t i = 0; i < num_nodes; ++i) {
    const NodeDescription& node = description_.nodes[i];
    model_.nodes_.push_back({node.name, MakePoint(ResolvedNode{i})});
    if (node.mass > 0.0 &&
        model_.nodes_.back().point.conventional_body.has_value()) {
      return absl::UnimplementedError(absl::StrCat(
          Item("nodes", i), "/mass: must be 0 [kg] for a node shared with a ",
          "conventional body, got ", NumberText(node.mass),
          "; make it part of the body's inertia, or use formulation \"ancf\""));
    }
    AddPointMass(model_.nodes_.back().point, node.mass);
  }
  if (model_.num_velocities_ == 0) {
    return absl::InvalidArgumentError(
        "/nodes: must leave a degree of freedom, got a model in which every "
        "node is fixed");
  }
  return absl::OkStatus();
}

Point ModelAssembler::BodyPointOf(const ResolvedBodyPoint& body_point) const {
  const ModelBody& body = model_.bodies_[body_point.body];
  Point point;
  if (body.conventional() != nullptr) {
    point.conventional_body = body_point.body;
    point.xi = body_point.xi;
    return point;
  }
  point.terms.push_back({body.first_vector, 1.0});
  for (int i = 0; i < 3; ++i) {
    if (body_point.xi(i) != 0.0) {
      point.terms.push_back({body.first_vector + 1 + i, body_point.xi(i)});
    }
  }
  return point;
}

Point ModelAssembler::MakePoint(const ResolvedPoint& resolved) const {
  if (const auto* body = std::get_if<ResolvedBodyPoint>(&resolved)) {
    return BodyPointOf(*body);
  }
  Point point;
  if (const auto* ground = std::get_if<ResolvedGround>(&resolved)) {
    point.ground = ground->position;
    return point;
  }
  const size_t node = std::get<ResolvedNode>(resolved).node;
  if (ties_.Anchor(node).has_value()) return MakePoint(*ties_.Anchor(node));
  point.terms.push_back({vector_of_node_[ties_.Representative(node)], 1.0});
  return point;
}

ModelAssembler::Motion ModelAssembler::MotionOf(const Point& point) const {
  Motion motion{DoubleDouble3::FromDouble(point.ground), Vector3d::Zero()};
  if (point.conventional_body.has_value()) {
    const size_t index = *point.conventional_body;
    const ModelBody& body = model_.bodies_[index];
    const DoubleDouble3 arm = BodyArm(state_, body, point.xi);
    for (int i = 0; i < 3; ++i) {
      motion.position[i] =
          DoubleDouble(state_.position.value(body.position_offset + i)) +
          arm[i];
    }
    motion.velocity = state_.velocity.value.segment<3>(body.velocity_offset) +
                      body_omega_[index].cross(arm.ToDouble());
    return motion;
  }
  for (const WeightedVector& term : point.terms) {
    const VectorCoordinate& v =
        model_.vectors_[static_cast<size_t>(term.vector)];
    for (int i = 0; i < 3; ++i) {
      motion.position[i] +=
          DoubleDouble(term.weight) *
          DoubleDouble(state_.position.value(v.position_offset + i),
                       state_.position.compensation(v.position_offset + i));
    }
    motion.velocity +=
        term.weight * state_.velocity.value.segment<3>(v.velocity_offset);
  }
  return motion;
}

ModelAssembler::Motion ModelAssembler::MotionOf(
    const ResolvedPoint& resolved) const {
  if (const auto* node = std::get_if<ResolvedNode>(&resolved)) {
    return {DoubleDouble3::FromDouble(description_.nodes[node->node].position),
            node_velocity_[node->node]};
  }
  return MotionOf(MakePoint(resolved));
}

void ModelAssembler::MeasureModel() {
  for (size_t i = 0; i < model_.bodies_.size(); ++i) {
    const RigidBodyInertia& inertia = model_.bodies_[i].inertia();
    size_ = std::max({size_, std::cbrt(inertia.volume),
                      std::sqrt(inertia.second_moment.trace() / inertia.mass),
                      description_.rigid_bodies[i].position.norm()});
    largest_omega_ = std::max(largest_omega_, body_omega_[i].norm());
  }
  for (const NodeDescription& node : description_.nodes) {
    size_ = std::max(size_, node.position.norm());
  }
}

absl::Status ModelAssembler::CheckTogether(const std::string& pointer,
                                           const Motion& first,
                                           const Motion& second) const {
  const double gap = Norm(first.position - second.position).ToDouble();
  const double size = std::max({size_, first.position.ToDouble().norm(),
                                second.position.ToDouble().norm()});
  if (!std::isfinite(gap) || !std::isfinite(size)) {
    const Vector3d a = first.position.ToDouble();
    const Vector3d b = second.position.ToDouble();
    return absl::InvalidArgumentError(absl::StrFormat(
        "%s: must join points so near that their distance [m] is a finite "
        "number, got [%.6g, %.6g, %.6g] and [%.6g, %.6g, %.6g] m",
        pointer, a(0), a(1), a(2), b(0), b(1), b(2)));
  }
  if (!(gap <= kAgreement * size)) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "%s: must coincide at the start, got a gap of %.6g m (allowed: %g of "
        "the model's size %.6g m)",
        pointer, gap, kAgreement, size));
  }
  const double difference = (first.velocity - second.velocity).norm();
  const double speed = std::max(
      {first.velocity.norm(), second.velocity.norm(), largest_omega_ * size});
  if (!(difference <= kAgreement * speed)) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "%s: must move alike at the start, got velocities [%.9g, %.9g, %.9g] "
        "and [%.9g, %.9g, %.9g] m/s, %.6g m/s apart",
        pointer, first.velocity(0), first.velocity(1), first.velocity(2),
        second.velocity(0), second.velocity(1), second.velocity(2),
        difference));
  }
  return absl::OkStatus();
}

// The second point is moved, by what CheckTogether allows, to where the first
// is, so that the gap is zero beyond a double.
absl::Status ModelAssembler::AddJoint(const AnchorPair& pair) {
  ModelJoint joint{.name = pair.pointer,
                   .points = {MakePoint(pair.first), MakePoint(pair.second)}};
  if (IsGround(pair.first)) std::swap(joint.points[0], joint.points[1]);
  Point& second = joint.points[1];
  for (const Point& point : joint.points) {
    if (point.terms.empty()) continue;
    const auto owner = std::find_if(
        model_.bodies_.begin(), model_.bodies_.end(), [&](const auto& body) {
          return body.first_vector == point.terms.front().vector;
        });
    return absl::UnimplementedError(
        absl::StrCat(pair.pointer, ": body \"", owner->name,
                     "\" of formulation \"ancf\" must not share a point with "
                     "a conventional body; structures that mix the two are not "
                     "supported yet"));
  }
  if (joint.points[0].conventional_body == second.conventional_body) {
    return absl::OkStatus();  // Of one body: they stay together.
  }
  const DoubleDouble3 gap =
      MotionOf(joint.points[0]).position - MotionOf(second).position;
  DoubleDouble3 place =
      DoubleDouble3::FromDouble(second.is_ground() ? second.ground : second.xi);
  if (second.is_ground()) {
    place += gap;
    second.ground = place.ToDouble();
  } else {
    const std::array<DoubleDouble3, 3> frame =
        BodyFrame(state_, model_.bodies_[*second.conventional_body]);
    for (int i = 0; i < 3; ++i) {
      place[i] += Dot(frame[static_cast<size_t>(i)], gap);
    }
    second.xi = place.ToDouble();
  }
  joint.rest = place.LowPart();
  model_.joints_.push_back(std::move(joint));
  return absl::OkStatus();
}

// The second point, moved in its body by what CheckTogether allows to where the
// first is: the forces of a joint with a gap would exert a moment. Gaps of
// rounding stay.
Point ModelAssembler::Closed(const AnchorPair& pair) const {
  const Point second = MakePoint(pair.second);
  const auto* given = std::get_if<ResolvedBodyPoint>(&pair.second);
  if (given == nullptr) return second;
  const DoubleDouble3 first = MotionOf(pair.first).position;
  const Vector3d gap = (first - MotionOf(pair.second).position).ToDouble();
  constexpr double kRounding = 0x1p-48;
  if (gap.norm() <= kRounding * std::max(size_, first.ToDouble().norm())) {
    return second;
  }
  ResolvedBodyPoint moved = *given;
  const Eigen::Index gradients =
      model_.bodies_[given->body].position_offset + 3;
  const Matrix3d frame = Eigen::Map<const Matrix3d>(
      state_.position.value.segment<9>(gradients).data());
  moved.xi += frame.inverse() * gap;
  return MakePoint(moved);
}

absl::Status ModelAssembler::AddConstraints() {
  std::vector<ModelConstraint> constraints;
  for (const AnchorPair& pair : ties_.remaining()) {
    // Ties through a chain of nodes are checked here, end to end.
    absl::Status status = CheckTogether(pair.pointer, MotionOf(pair.first),
                                        MotionOf(pair.second));
    if (!status.ok()) return status;
    if (MakePoint(pair.first).conventional_body.has_value() ||
        MakePoint(pair.second).conventional_body.has_value()) {
      status = AddJoint(pair);
      if (!status.ok()) return status;
      continue;
    }
    std::map<int, double> row;
    for (const WeightedVector& term : MakePoint(pair.first).terms) {
      row[term.vector] += term.weight;
    }
    for (const WeightedVector& term : Closed(pair).terms) {
      row[term.vector] -= term.weight;
    }
    ModelConstraint constraint{
        .name = pair.pointer,
        .terms = {},
        .to_ground = IsGround(pair.first) || IsGround(pair.second)};
    for (const auto& [vector, weight] : row) {
      if (weight != 0.0) constraint.terms.push_back({vector, weight});
    }
    if (!constraint.terms.empty()) constraints.push_back(std::move(constraint));
  }
  model_.constraints_ = IndependentConstraints(std::move(constraints));
  std::vector<Matrix3d> rotations;
  if (!model_.joints_.empty()) {
    for (const ModelBody& body : model_.bodies_) {
      Matrix3d& rotation = rotations.emplace_back(Matrix3d::Identity());
      if (body.conventional() == nullptr) continue;
      const std::array<DoubleDouble3, 3> frame = BodyFrame(state_, body);
      for (int i = 0; i < 3; ++i) {
        rotation.col(i) = frame[static_cast<size_t>(i)].ToDouble();
      }
    }
  }
  model_.joints_ =
      IndependentJoints(model_.bodies_, rotations, std::move(model_.joints_));
  if (model_.degrees_of_freedom() <= 0) {
    return absl::InvalidArgumentError(
        "/shared_points: must leave a degree of freedom, got as many "
        "constraints as coordinates");
  }
  return absl::OkStatus();
}

void ModelAssembler::AddMassBetween(const Point& first, const Point& second,
                                    double mass) {
  for (const WeightedVector& a : first.terms) {
    for (const WeightedVector& b : second.terms) {
      mass_[static_cast<size_t>(a.vector)][b.vector] +=
          a.weight * b.weight * mass;
    }
    if (second.is_ground()) {
      model_.ground_mass_.push_back({second.ground, a.vector, a.weight * mass});
    }
  }
}

void ModelAssembler::AddPointMass(const Point& point, double mass) {
  if (mass == 0.0) return;
  AddMassBetween(point, point, mass);
  for (const WeightedVector& term : point.terms) {
    model_.vectors_[static_cast<size_t>(term.vector)].first_moment +=
        term.weight * mass;
  }
}

void ModelAssembler::AddConsistentMass(const std::array<Point, 2>& ends,
                                       double mass) {
  if (mass == 0.0) return;
  for (size_t i = 0; i < 2; ++i) {
    AddMassBetween(ends[i], ends[i], mass / 3.0);
    AddMassBetween(ends[i], ends[1 - i], mass / 6.0);
    for (const WeightedVector& term : ends[i].terms) {
      model_.vectors_[static_cast<size_t>(term.vector)].first_moment +=
          term.weight * (0.5 * mass);
    }
  }
}

absl::StatusOr<std::array<Point, 2>> ModelAssembler::MakeEnds(
    const std::string& pointer,
    const std::array<PointDescription, 2>& ends) const {
  std::array<Point, 2> points;
  for (size_t i = 0; i < 2; ++i) {
    const absl::StatusOr<ResolvedPoint> resolved =
        Resolve(absl::StrCat(pointer, "/ends/", i), ends[i]);
    if (!resolved.ok()) return resolved.status();
    points[i] = MakePoint(*resolved);
  }
  const std::array<DoubleDouble3, 2> places = {MotionOf(points[0]).position,
                                               MotionOf(points[1]).position};
  if (!std::isfinite(Norm(places[1] - places[0]).ToDouble())) {
    const std::array<Vector3d, 2> x = {places[0].ToDouble(),
                                       places[1].ToDouble()};
    const size_t far =
        x[1].lpNorm<Eigen::Infinity>() > x[0].lpNorm<Eigen::Infinity>() ? 1 : 0;
    return FieldError(
        absl::StrCat(pointer, "/ends/", far),
        "a point whose distance from the other end has a finite square [m]",
        absl::StrCat("[", NumberText(x[far](0)), ", ", NumberText(x[far](1)),
                     ", ", NumberText(x[far](2)), "]"));
  }
  return points;
}

absl::Status ModelAssembler::AddLine(const std::string& pointer,
                                     const std::string& name,
                                     const LineElement& element,
                                     const std::array<Point, 2>& ends,
                                     double mass) {
  const absl::Status has_mass = CheckMass(pointer, mass);
  if (!has_mass.ok()) return has_mass;
  ModelLine line{.name = name,
                 .element = element,
                 .ends = ends,
                 .difference = {},
                 .mass = mass,
                 .strain_offset = model_.num_strains_};
  std::map<int, double> row;
  for (const WeightedVector& term : ends[0].terms) {
    row[term.vector] -= term.weight;
  }
  for (const WeightedVector& term : ends[1].terms) {
    row[term.vector] += term.weight;
  }
  for (const auto& [vector, weight] : row) {
    if (weight != 0.0) line.difference.terms.push_back({vector, weight});
  }
  if (line.difference.terms.empty() && !ends[0].conventional_body.has_value() &&
      !ends[1].conventional_body.has_value()) {
    return FieldError(pointer + "/ends", "two points that can move apart",
                      "two ends at one point or both on the ground");
  }
  line.difference.ground = ends[1].ground - ends[0].ground;
  const DoubleDouble value =
      element.Value(MotionOf(ends[1]).position - MotionOf(ends[0]).position);
  const Eigen::Index s = model_.num_strains_++;
  if (state_.strain.value.size() <= s) {
    // Doubling, so that a large net is not copied at every element.
    const Eigen::Index room = std::max<Eigen::Index>(64, 2 * s);
    state_.strain.value.conservativeResize(room);
    state_.strain.compensation.conservativeResize(room);
  }
  for (size_t i = 0; i < 2; ++i) {
    if (mass == 0.0 || !ends[i].conventional_body.has_value()) continue;
    line.end_velocity_offset[i] = model_.num_end_velocities_;
    model_.num_end_velocities_ += 3;
    Append(MotionOf(ends[i]).velocity, &state_.end_velocity.value);
  }
  state_.strain.value(s) = value.hi;
  state_.strain.compensation(s) = value.lo;
  AddConsistentMass(ends, mass);
  model_.lines_.push_back(std::move(line));
  return absl::OkStatus();
}

absl::Status ModelAssembler::AddTrusses() {
  for (size_t i = 0; i < description_.trusses.size(); ++i) {
    const TrussDescription& truss = description_.trusses[i];
    const std::string pointer = Item("trusses", i);
    absl::Status status =
        AddName(pointer, truss.name, NamedItem::Kind::kLine, i);
    if (!status.ok()) return status;
    status = CheckPositive(pointer + "/area", truss.area, "m^2");
    if (!status.ok()) return status;
    status = CheckNotNegative(pointer + "/density", truss.density, "kg/m^3");
    if (!status.ok()) return status;
    status =
        CheckPositive(pointer + "/young_modulus", truss.young_modulus, "Pa");
    if (!status.ok()) return status;
    absl::StatusOr<std::array<Point, 2>> ends = MakeEnds(pointer, truss.ends);
    if (!ends.ok()) return ends.status();
    const double distance =
        Norm(MotionOf((*ends)[1]).position - MotionOf((*ends)[0]).position)
            .ToDouble();
    if (truss.length.has_value()) {
      status = CheckPositive(pointer + "/length", *truss.length, "m");
      if (!status.ok()) return status;
    } else if (!(distance > 0.0)) {
      return FieldError(pointer + "/ends",
                        "apart at the start, where length is not given [m]",
                        "a distance of " + NumberText(distance));
    }
    const double length = truss.length.value_or(distance);
    const double axial_stiffness = truss.young_modulus * truss.area;
    status = AddLine(pointer, truss.name,
                     truss.tension_only
                         ? LineElement::Cable(length, axial_stiffness)
                         : LineElement::Truss(length, axial_stiffness),
                     *ends, truss.density * truss.area * length);
    if (!status.ok()) return status;
  }
  return absl::OkStatus();
}

absl::Status ModelAssembler::AddSprings() {
  for (size_t i = 0; i < description_.springs.size(); ++i) {
    const SpringDescription& spring = description_.springs[i];
    const std::string pointer = Item("springs", i);
    absl::Status status =
        AddName(pointer, spring.name, NamedItem::Kind::kLine, i);
    if (!status.ok()) return status;
    status = CheckPositive(pointer + "/stiffness", spring.stiffness, "N/m");
    if (!status.ok()) return status;
    status = CheckNotNegative(pointer + "/length", spring.length, "m");
    if (!status.ok()) return status;
    absl::StatusOr<std::array<Point, 2>> ends = MakeEnds(pointer, spring.ends);
    if (!ends.ok()) return ends.status();
    status = AddLine(pointer, spring.name,
                     LineElement::Spring(spring.length, spring.stiffness),
                     *ends, 0.0);
    if (!status.ok()) return status;
  }
  state_.strain.value.conservativeResize(model_.num_strains_);
  state_.strain.compensation.conservativeResize(model_.num_strains_);
  return absl::OkStatus();
}

absl::Status ModelAssembler::AddLoads() {
  for (size_t i = 0; i < description_.loads.size(); ++i) {
    const std::string pointer = Item("loads", i);
    if (const auto* force = std::get_if<ForceLoad>(&description_.loads[i])) {
      absl::Status status = CheckFinite(pointer + "/force", force->force, "N");
      if (!status.ok()) return status;
      const absl::StatusOr<ResolvedPoint> point =
          Resolve(pointer + "/point", force->point);
      if (!point.ok()) return point.status();
      model_.forces_.push_back({MakePoint(*point), force->force});
      continue;
    }
    const auto& torque = std::get<TorqueLoad>(description_.loads[i]);
    absl::Status status =
        CheckFinite(pointer + "/torque", torque.torque, "N m");
    if (!status.ok()) return status;
    const absl::StatusOr<ResolvedPoint> body =
        Resolve(pointer, BodyPoint{torque.body, Vector3d::Zero()});
    if (!body.ok()) return body.status();
    model_.torques_.push_back(
        {std::get<ResolvedBodyPoint>(*body).body, torque.torque});
  }
  return absl::OkStatus();
}

absl::Status ModelAssembler::CheckMasses() const {
  // Every element with mass is positive definite in its ends, so that the
  // whole is singular only where a node has no mass at all.
  for (size_t i = 0; i < description_.nodes.size(); ++i) {
    const int vector = vector_of_node_[i];
    if (vector < 0) continue;
    const std::map<int, double>& row = mass_[static_cast<size_t>(vector)];
    const auto diagonal = row.find(vector);
    if (diagonal != row.end() && diagonal->second > 0.0) continue;
    const bool attached = std::any_of(
        model_.lines_.begin(), model_.lines_.end(), [vector](const auto& line) {
          return std::any_of(
              line.difference.terms.begin(), line.difference.terms.end(),
              [vector](const auto& term) { return term.vector == vector; });
        });
    return absl::InvalidArgumentError(absl::StrCat(
        Item("nodes", i), ": node \"", description_.nodes[i].name,
        attached ? "\" must have mass, got 0 and only massless elements "
                   "attached: the mass matrix is singular [kg]"
                 : "\" must have mass or be attached to something, got "
                   "neither"));
  }
  return absl::OkStatus();
}

}  // namespace emmy
