// Which structures are ANCF bodies joined at shared points, and the chains.

#ifndef EMMY_INTEGRATE_JOINT_GRAPH_H_
#define EMMY_INTEGRATE_JOINT_GRAPH_H_

#include <array>
#include <optional>
#include <vector>

#include "emmy/integrate/structure.h"

namespace emmy {

// A constraint as its bodies see it.
struct BodyJoint {
  static constexpr int kNone = -1;
  // Numbers in Structure::bodies; the second is kNone for a joint to the
  // ground.
  std::array<int, 2> bodies = {kNone, kNone};
  // Weights of x̄, e₁, e₂, e₃ of each: its columns of G.
  std::array<Vector4d, 2> weights = {Vector4d::Zero(), Vector4d::Zero()};
};

// The joints of `structure`, in the order of its constraints; empty if there
// are other parts than bodies in principal axes, joined to each other and to
// the ground.
std::vector<BodyJoint> FindBodyJoints(const Structure& structure);

// Of one of its joints on a body; zero for kNone.
Vector4d JointWeights(const std::vector<BodyJoint>& joints, int joint,
                      int body);

// Where the state has a joint's force.
Eigen::Index MultiplierOffset(const Structure& structure, int joint);

// Bodies in a row: `bodies[i]` has the joint `joints[i]` on its right, which
// is on the left of body i + 1. A joint at the start, to the ground, is on the
// right of a body kNone.
struct BodyRow {
  std::vector<int> bodies;
  std::vector<int> joints;
};

// None if some body has more than two joints, or they close a loop.
std::optional<BodyRow> FindBodyRow(const Structure& structure,
                                   const std::vector<BodyJoint>& joints);

}  // namespace emmy

#endif  // EMMY_INTEGRATE_JOINT_GRAPH_H_
