#include "emmy/integrate/joint_graph.h"

#include <utility>

namespace emmy {
namespace {

bool IsPrincipal(const AncfRigidBody& body) {
  const Matrix3d diagonal = body.second_moment().diagonal().asDiagonal();
  return body.second_moment() == diagonal;
}

}  // namespace

std::vector<BodyJoint> FindBodyJoints(const Structure& structure) {
  if (structure.constraints.empty() || !structure.lines.empty() ||
      structure.has_added_mass ||
      structure.vectors.size() != 4 * structure.bodies.size()) {
    return {};
  }
  std::vector<int> owner(structure.vectors.size(), BodyJoint::kNone);
  for (size_t b = 0; b < structure.bodies.size(); ++b) {
    const Structure::Body& body = structure.bodies[b];
    if (!IsPrincipal(*body.body->ancf())) return {};
    for (int a = 0; a < 4; ++a) {
      owner[static_cast<size_t>(body.first + a)] = static_cast<int>(b);
    }
  }
  std::vector<BodyJoint> joints;
  joints.reserve(structure.constraints.size());
  for (const Structure::Constraint& constraint : structure.constraints) {
    BodyJoint& joint = joints.emplace_back();
    for (const WeightedVector& term : constraint.terms) {
      const int body = owner[static_cast<size_t>(term.vector)];
      size_t side = 0;
      if (joint.bodies[0] != BodyJoint::kNone && joint.bodies[0] != body) {
        side = 1;
        if (joint.bodies[1] != BodyJoint::kNone && joint.bodies[1] != body) {
          return {};
        }
      }
      joint.bodies[side] = body;
      joint.weights[side](term.vector -
                          structure.bodies[static_cast<size_t>(body)].first) +=
          term.weight;
    }
  }
  return joints;
}

Vector4d JointWeights(const std::vector<BodyJoint>& joints, int joint,
                      int body) {
  if (joint == BodyJoint::kNone || body == BodyJoint::kNone) {
    return Vector4d::Zero();
  }
  const BodyJoint& found = joints[static_cast<size_t>(joint)];
  for (size_t side = 0; side < 2; ++side) {
    if (found.bodies[side] == body) return found.weights[side];
  }
  return Vector4d::Zero();
}

Eigen::Index MultiplierOffset(const Structure& structure, int joint) {
  return 3 * static_cast<Eigen::Index>(
                 structure.constraints[static_cast<size_t>(joint)].index);
}

std::optional<BodyRow> FindBodyRow(const Structure& structure,
                                   const std::vector<BodyJoint>& joints) {
  constexpr int kNone = BodyJoint::kNone;
  // At most two joints a body.
  std::vector<std::array<int, 2>> of_body(structure.bodies.size(),
                                          {kNone, kNone});
  for (size_t j = 0; j < joints.size(); ++j) {
    for (const int body : joints[j].bodies) {
      if (body == kNone) continue;
      std::array<int, 2>& mine = of_body[static_cast<size_t>(body)];
      const size_t place = mine[0] == kNone ? 0 : 1;
      if (mine[place] != kNone) return std::nullopt;
      mine[place] = static_cast<int>(j);
    }
  }
  const auto to_ground = [&joints](int joint) {
    return joint == kNone ||
           joints[static_cast<size_t>(joint)].bodies[1] == BodyJoint::kNone;
  };
  // An end of the row: a body with one neighbour at most.
  for (size_t b = 0; b < of_body.size(); ++b) {
    std::array<int, 2> ends = of_body[b];
    if (!to_ground(ends[0])) std::swap(ends[0], ends[1]);
    if (!to_ground(ends[0])) continue;
    BodyRow row;
    if (ends[0] != kNone) {
      row.bodies.push_back(kNone);
      row.joints.push_back(ends[0]);
    }
    int body = static_cast<int>(b);
    int left = ends[0];
    for (;;) {
      const std::array<int, 2>& mine = of_body[static_cast<size_t>(body)];
      const int right = mine[0] == left ? mine[1] : mine[0];
      row.bodies.push_back(body);
      row.joints.push_back(right);
      if (to_ground(right)) return row;
      const auto& [first, second] = joints[static_cast<size_t>(right)].bodies;
      body = first == body ? second : first;
      left = right;
    }
  }
  return std::nullopt;
}

}  // namespace emmy
