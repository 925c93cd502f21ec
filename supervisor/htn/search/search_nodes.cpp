// What becomes of the nodes of a search. A node is dead when all below it is, and what it came back to above
// it is too: until that is known it is conditional, and belongs to the frame above it (as the components of
// Tarjan 1972).

#include <algorithm>

#include "supervisor/htn/search/search_engine.h"

namespace stepwright::htn {

void Search::Implementation::settle(Frame& frame, NodeStatus status, std::uint32_t depth) {
  nodes_.record(frame.node) = {status, depth};
  for (const Fingerprint& node : frame.conditional) nodes_.record(node) = {status, depth};
}

// The last frame has nothing more to try.
void Search::Implementation::close() {
  Frame& frame = frames_[depth_ - 1];
  const auto depth = static_cast<std::uint32_t>(depth_ - 1);
  // What a prefix is rejected for, others may not have.
  const bool comparable = attachment_ == nullptr ? !frame.by_prefix : attachment_->fingerprint().has_value();
  --depth_;
  if (!frame.solved) ++statistics_.dead_ends;
  if (depth_ == 0) {
    given_up_ = given_up_ || frame.given_up;
    return;
  }
  Frame& above = frames_[depth_ - 1];
  above.given_up = above.given_up || frame.given_up;
  above.solved = above.solved || frame.solved;
  above.by_prefix = above.by_prefix || frame.by_prefix;
  if (frame.solved || !comparable) {
    settle(frame, NodeStatus::Unknown, 0);
  } else if (frame.lowest == depth) {
    settle(frame, frame.given_up ? NodeStatus::GivenUp : NodeStatus::Dead, 0);
  } else {
    settle(frame, NodeStatus::Conditional, frame.lowest);
    above.lowest = std::min(above.lowest, frame.lowest);
    above.conditional.push_back(frame.node);
    above.conditional.insert(above.conditional.end(), frame.conditional.begin(), frame.conditional.end());
  }
}

// Whether nothing new can come from the node.
bool Search::Implementation::known(Frame& from, const Fingerprint& node) {
  const NodeRecord record = nodes_.record(node);
  switch (record.status) {
    case NodeStatus::Unknown:
      return false;
    case NodeStatus::Open:
      ++statistics_.loops;
      // States that cannot be compared may differ after all.
      if (attachment_ != nullptr && !attachment_->fingerprint()) from.given_up = true;
      from.lowest = std::min(from.lowest, record.depth);
      return true;
    case NodeStatus::Conditional:
      from.lowest = std::min(from.lowest, record.depth);
      break;
    case NodeStatus::GivenUp:
      from.given_up = true;
      break;
    case NodeStatus::Dead:
      break;
  }
  ++statistics_.known_nodes;
  return true;
}

// Stages, and choices that differ in nothing that is done, may find a decomposition again.
bool Search::Implementation::is_new_plan() {
  Fingerprint plan;
  for (std::size_t i = 0; i < depth_; ++i) {
    plan = followed_by(plan, static_cast<std::uint64_t>(frames_[i].chosen_method));
    plan = followed_by(plan, static_cast<std::uint64_t>(frames_[i].chosen) + 2);
  }
  return found_.insert(plan).second;
}

}  // namespace stepwright::htn
