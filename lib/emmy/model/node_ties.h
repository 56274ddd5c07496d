// Which nodes are the same point, and what they are tied to.
//
// Shared points between nodes make them one; a node shared with a body point
// or the ground is eliminated: it becomes that point. What is left are pairs
// of body and ground points, which become constraints.

#ifndef EMMY_MODEL_NODE_TIES_H_
#define EMMY_MODEL_NODE_TIES_H_

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "emmy/base/disjoint_sets.h"
#include "emmy/base/types.h"

namespace emmy {

// A described point with its name looked up.
struct ResolvedBodyPoint {
  size_t body = 0;
  Vector3d xi = Vector3d::Zero();
};
// A node.
struct ResolvedNode {
  size_t node = 0;
};
// A point fixed in space.
struct ResolvedGround {
  Vector3d position = Vector3d::Zero();
};
using ResolvedPoint =
    std::variant<ResolvedBodyPoint, ResolvedNode, ResolvedGround>;

// Two body or ground points to be kept together.
struct AnchorPair {
  ResolvedPoint first;
  ResolvedPoint second;
  std::string pointer;
};

class NodeTies {
 public:
  explicit NodeTies(size_t num_nodes);

  // Ties the two points of a shared point, or a fixed node to its place.
  void Tie(const ResolvedPoint& first, const ResolvedPoint& second,
           const std::string& pointer);

  // The node that stands for all nodes tied to `node`.
  size_t Representative(size_t node) const;

  // The body or ground point that `node` is tied to, if any.
  const std::optional<ResolvedPoint>& Anchor(size_t node) const;

  // Further ties, between bodies or of a node already anchored.
  const std::vector<AnchorPair>& remaining() const { return remaining_; }

 private:
  void Attach(size_t node, const ResolvedPoint& anchor,
              const std::string& pointer);

  DisjointSets nodes_;
  std::vector<std::optional<ResolvedPoint>> anchor_;  // Of representatives.
  std::vector<AnchorPair> remaining_;
};

}  // namespace emmy

#endif  // EMMY_MODEL_NODE_TIES_H_
