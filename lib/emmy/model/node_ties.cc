#include "emmy/model/node_ties.h"

#include <utility>

namespace emmy {

NodeTies::NodeTies(size_t num_nodes) : nodes_(num_nodes), anchor_(num_nodes) {}

size_t NodeTies::Representative(size_t node) const { return nodes_.Find(node); }

const std::optional<ResolvedPoint>& NodeTies::Anchor(size_t node) const {
  return anchor_[Representative(node)];
}

void NodeTies::Attach(size_t node, const ResolvedPoint& anchor,
                      const std::string& pointer) {
  std::optional<ResolvedPoint>& present = anchor_[Representative(node)];
  if (present.has_value()) {
    remaining_.push_back({*present, anchor, pointer});
  } else {
    present = anchor;
  }
}

void NodeTies::Tie(const ResolvedPoint& first, const ResolvedPoint& second,
                   const std::string& pointer) {
  const auto* first_node = std::get_if<ResolvedNode>(&first);
  const auto* second_node = std::get_if<ResolvedNode>(&second);
  if (first_node == nullptr && second_node == nullptr) {
    remaining_.push_back({first, second, pointer});
    return;
  }
  if (first_node == nullptr) {
    Attach(second_node->node, first, pointer);
    return;
  }
  if (second_node == nullptr) {
    Attach(first_node->node, second, pointer);
    return;
  }
  const size_t kept = Representative(first_node->node);
  const size_t joined = Representative(second_node->node);
  if (kept == joined) return;
  nodes_.Join(kept, joined);
  std::optional<ResolvedPoint> anchor;
  anchor.swap(anchor_[joined]);
  if (anchor.has_value()) Attach(kept, *anchor, pointer);
}

}  // namespace emmy
