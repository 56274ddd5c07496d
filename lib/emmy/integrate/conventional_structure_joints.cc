// The joints of ConventionalStructureStep.                   (CONJ-1 to CONJ-5)

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "emmy/integrate/conventional_structure_step.h"
#include "emmy/numerics/rotation.h"

namespace emmy {
namespace {

DoubleDouble Extended(const CompensatedVector& vector, Eigen::Index index) {
  return DoubleDouble(TwoSum(vector.value(index), vector.compensation(index)));
}

}  // namespace

absl::Status ConventionalStructureStep::GatherJoints() {
  for (size_t i = 0; i < model_->joints().size(); ++i) {
    Joint joint;
    joint.joint = &model_->joints()[i];
    joint.multiplier = 3 * static_cast<Index>(model_->constraints().size() + i);
    for (size_t e = 0; e < 2; ++e) {
      absl::StatusOr<End> end = MakeEnd(joint.joint->points[e]);
      if (!end.ok()) return end.status();
      joint.ends[e] = *end;
    }
    joints_.push_back(joint);
  }
  for (Body& body : bodies_) {
    const ConventionalRigidBody& element = *body.body->conventional();
    body.gyration = std::sqrt(0.5 * element.tensor().trace() / element.mass());
  }
  return absl::OkStatus();
}

// The multipliers are eliminated after both velocities of all their bodies
// (block_lu.h).
void ConventionalStructureStep::MakePattern() {
  const auto blocks = [this](const End& end) -> std::vector<int> {
    if (end.body >= 0) return {BodyBlock(end.body), BodyBlock(end.body) + 1};
    if (end.node >= 0) return {NodeBlock(end.node)};
    return {};
  };
  std::vector<std::pair<int, int>> pairs;
  const auto join = [&pairs](const std::vector<int>& a,
                             const std::vector<int>& b) {
    for (const int i : a) {
      for (const int j : b) {
        if (i != j) pairs.emplace_back(i, j);
      }
    }
  };
  for (const Mass& mass : masses_) {
    join({NodeBlock(mass.row)}, {NodeBlock(mass.column)});
  }
  for (const Line& line : lines_) {
    for (const End& a : line.ends) {
      for (const End& b : line.ends) join(blocks(a), blocks(b));
    }
  }
  std::vector<std::vector<int>> waits_for(static_cast<size_t>(NumBlocks()));
  for (size_t i = 0; i < joints_.size(); ++i) {
    const int row = JointBlock(static_cast<int>(i));
    for (const End& end : joints_[i].ends) {
      join({row}, blocks(end));
      if (end.body < 0) continue;
      for (const int block : blocks(end)) {
        waits_for[static_cast<size_t>(row)].push_back(block);
      }
    }
  }
  tangent_.MakeSparse(NumBlocks(), pairs, waits_for);
}

// x + R ξ, with what doubles leave out of it.
DoubleDouble3 ConventionalStructureStep::Place(const State& state,
                                               const End& end,
                                               const Vector3d& rest) const {
  DoubleDouble3 place = DoubleDouble3::FromDouble(end.start);
  if (end.body < 0) return place + DoubleDouble3::FromDouble(rest);
  const Body& body = bodies_[static_cast<size_t>(end.body)];
  const Index q = body.body->position_offset;
  for (int i = 0; i < 3; ++i) {
    place[i] = Extended(state.position, q + i);
  }
  for (int i = 0; i < 3; ++i) {
    if (end.xi(i) == 0.0 && rest(i) == 0.0) continue;
    place += DoubleDouble(TwoSum(end.xi(i), rest(i))) *
             body.frame[static_cast<size_t>(i)];
  }
  return place;
}

void ConventionalStructureStep::LoadJoints(const State& state) {
  if (joints_.empty()) return;
  for (Body& body : bodies_) {
    const Index q = body.body->position_offset + 3;
    body.frame = QuaternionToMatrix(
        {Extended(state.position, q), Extended(state.position, q + 1),
         Extended(state.position, q + 2), Extended(state.position, q + 3)});
  }
  for (size_t i = 0; i < joints_.size(); ++i) {
    Joint& joint = joints_[i];
    for (End& end : joint.ends) LoadEnd(state, &end);
    const DoubleDouble3 gap = Place(state, joint.ends[0], Vector3d::Zero()) -
                              Place(state, joint.ends[1], joint.joint->rest);
    joint.closing_rate = gap.ToDouble() / time_step_;
    if (joint.joint->num_held < 3) {
      const Matrix3d& turn =
          bodies_[static_cast<size_t>(joint.ends[0].body)].rotation;
      joint.held = turn * joint.joint->held * turn.transpose();
    }
    unknown_.segment<3>(JointRow(static_cast<int>(i))) =
        joint.held *
        (time_step_ * state.multiplier.next.segment<3>(joint.multiplier));
  }
}

// Mean velocity of an end, from the start's and the rest.
std::pair<Vector3d, Vector3d> ConventionalStructureStep::SplitRate(
    const End& end) const {
  if (end.body < 0) return {Vector3d::Zero(), Vector3d::Zero()};
  const Body& body = bodies_[static_cast<size_t>(end.body)];
  return {body.v0, (body.v0_compensation +
                    0.5 * unknown_.segment<3>(BodyRow(end.body))) +
                       (body.rotation * body.mean_omega).cross(end.arm)};
}

void ConventionalStructureStep::EvaluateJoints() {
  for (size_t i = 0; i < joints_.size(); ++i) {
    Joint& joint = joints_[i];
    const Index row = JointRow(static_cast<int>(i));
    for (End& end : joint.ends) EvaluateEnd(&end);
    const Vector3d impulse = unknown_.segment<3>(row);
    AddImpulse(joint.ends[0], impulse);
    AddImpulse(joint.ends[1], -impulse);
    // A common motion cancels before it is rounded.
    const auto [first, first_rest] = SplitRate(joint.ends[0]);
    const auto [second, second_rest] = SplitRate(joint.ends[1]);
    residual_.segment<3>(row) =
        2.0 * (joint.held * ((first - second) + ((first_rest - second_rest) +
                                                 joint.closing_rate)));
  }
}

void ConventionalStructureStep::AddJointsToTangent() {
  if (joints_.empty()) return;
  const double quarter = 0.25 * time_step_;
  for (size_t b = 0; b < bodies_.size(); ++b) {
    const Body& body = bodies_[b];
    const int row = BodyBlock(static_cast<int>(b)) + 1;
    tangent_.Add(row, row,
                 quarter * Hat(body.rotation.transpose() * body.torque));
  }
  for (size_t i = 0; i < joints_.size(); ++i) {
    const Joint& joint = joints_[i];
    const int row = JointBlock(static_cast<int>(i));
    const Vector3d impulse = unknown_.segment<3>(JointRow(static_cast<int>(i)));
    for (size_t e = 0; e < 2; ++e) {
      const End& end = joint.ends[e];
      if (end.body < 0) continue;
      const Body& body = bodies_[static_cast<size_t>(end.body)];
      const double sign = e == 0 ? 1.0 : -1.0;
      const int v = BodyBlock(end.body);
      const Matrix3d arm = Hat(body.rotation.transpose() * end.arm);
      const Matrix3d lever = sign * body.inverse_mean_rotation * body.rotation;
      tangent_.Add(v, row, sign * joint.held);
      tangent_.Add(row, v, sign * joint.held);
      tangent_.Add(v + 1, row,
                   lever * arm * body.rotation.transpose() * joint.held);
      tangent_.Add(row, v + 1, -sign * joint.held * body.mean_rotation * arm);
      tangent_.Add(v + 1, v + 1,
                   quarter * lever * Hat(body.rotation.transpose() * impulse) *
                       (body.rotation.transpose() * body.mean_rotation) * arm);
    }
    if (joint.joint->num_held < 3) {
      const Body& body = bodies_[static_cast<size_t>(joint.ends[0].body)];
      tangent_.Add(row, row,
                   (joint.held - Matrix3d::Identity()) /
                       body.body->conventional()->mass());
    }
  }
}

// Shortens the correction so that no body turns by more than a third of a
// radian: far from the solution, Newton's method overshoots.
void ConventionalStructureStep::LimitTurns() {
  constexpr double kLargestTurn = 0.3;
  double turn = 0.0;
  for (size_t b = 0; b < bodies_.size(); ++b) {
    const Index row = BodyRow(static_cast<int>(b)) + 3;
    turn = std::max(
        turn, 0.5 * std::abs(time_step_) * correction_.segment<3>(row).norm());
  }
  if (turn > kLargestTurn) correction_ *= kLargestTurn / turn;
}

// Whether the residual's work (EM-7) is small against the energy of the start
// and the work of the loads: an iterate that has run away is solved to the
// round-off of its own size.
bool ConventionalStructureStep::KeepsEnergy() const {
  if (options_.tolerance.has_value()) return true;
  double energy = 0.0;
  for (const Body& body : bodies_) {
    const ConventionalRigidBody& element = *body.body->conventional();
    energy += 0.5 * (element.mass() * body.v0.squaredNorm() +
                     body.w0.dot(element.tensor() * body.w0)) +
              element.mass() * std::abs(model_->gravity().dot(body.increment));
  }
  for (const Node& node : nodes_) {
    energy += node.vector->first_moment *
              (0.5 * node.w0.squaredNorm() +
               std::abs(model_->gravity().dot(node.increment)));
  }
  for (const Line& line : lines_) {
    energy += line.line->element.Energy(line.strain).ToDouble();
  }
  for (const Force& force : forces_) {
    energy += std::abs(force.force.dot(force.end.increment));
  }
  for (const Torque& torque : torques_) {
    const Body& body = bodies_[static_cast<size_t>(torque.body)];
    energy += std::abs(time_step_ *
                       torque.torque.dot(body.rotation * body.mean_omega));
  }
  return std::abs(Work()) <= kLargestShare * energy;
}

// Directions that other joints hold at the start need not be held by them for
// ever. Far above rounding; a gap of that share moves the angular momentum, by
// (CONJ-3), by as much of an impulse's moment.
const ModelJoint* ConventionalStructureStep::OpenJoint() const {
  constexpr double kLargestGap = 1e-11;
  for (const Joint& joint : joints_) {
    if (joint.joint->num_held == 3) continue;
    const auto& [first, second] = joint.ends;
    const Vector3d gap =
        time_step_ * joint.closing_rate + (first.increment - second.increment);
    const double size = first.xi.norm() + second.xi.norm() +
                        bodies_[static_cast<size_t>(first.body)].gyration;
    if (!(gap.norm() <= kLargestGap * size)) return joint.joint;
  }
  return nullptr;
}

void ConventionalStructureStep::CommitJoints(State& state) const {
  Extrapolation::Errors errors{};
  for (size_t i = 0; i < joints_.size(); ++i) {
    state.multiplier.Add(
        joints_[i].multiplier,
        unknown_.segment<3>(JointRow(static_cast<int>(i))) / time_step_,
        &errors);
  }
  const int order = Extrapolation::BestOrder(errors);
  for (const Joint& joint : joints_) {
    state.multiplier.Predict(joint.multiplier, 3, order);
  }
}

}  // namespace emmy
