#include "supervisor/ltl/automaton/diagram.h"

#include <algorithm>
#include <utility>

namespace stepwright::ltl {

namespace {

constexpr std::size_t kFirstSlots = 1u << 10, kMostAnswers = 1u << 20;
constexpr std::size_t kMostStepsPerNode = 16;  // of one answer

std::size_t mixed(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  std::uint64_t hash = (std::uint64_t{b} << 32 | c) * 0x9E3779B97F4A7C15u;
  hash ^= (hash >> 32) + a * 0xC2B2AE3D27D4EB4Fu;
  return hash * 0x9E3779B97F4A7C15u >> 20;
}

}  // namespace

Diagram::Diagram(std::size_t most_nodes)
    : most_(most_nodes), nodes_(2), slots_(kFirstSlots, kFalse), answers_(kFirstSlots) {}

// Twice as many places for nodes, and for answers up to a bound.
void Diagram::grow() {
  slots_.assign(2 * slots_.size(), kFalse);
  for (Node node = kTrue + 1; node < nodes_.size(); ++node) slots_[slot_of(nodes_[node])] = node;
  if (answers_.size() < kMostAnswers) answers_.assign(slots_.size(), {});
}

// Where a node stands, or the free place for it.
std::size_t Diagram::slot_of(const Inner& inner) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = mixed(inner.level, inner.low, inner.high) & mask;
  while (slots_[slot] != kFalse && nodes_[slots_[slot]] != inner) slot = (slot + 1) & mask;
  return slot;
}

Diagram::Answer& Diagram::answer_of(const Question& asked) {
  return answers_[mixed(asked.condition, asked.otherwise, asked.then) & (answers_.size() - 1)];
}

Diagram::Node Diagram::make(std::uint32_t level, Node low, Node high) {
  if (low == high) return low;
  const Inner inner{level, low, high};
  const std::size_t slot = slot_of(inner);
  if (slots_[slot] != kFalse) return slots_[slot];
  if (nodes_.size() >= most_) {
    exhausted_ = true;
    return kFalse;
  }
  const auto node = static_cast<Node>(nodes_.size());
  nodes_.push_back(inner);
  slots_[slot] = node;
  if (2 * nodes_.size() > slots_.size()) grow();
  return node;
}

Diagram::Node Diagram::variable(std::uint32_t level) {
  return make(level, kFalse, kTrue);
}

std::optional<Diagram::Node> Diagram::at_once(Question& asked) {
  auto& [condition, otherwise, then] = asked;
  if (condition == kTrue) return then;
  if (condition == kFalse) return otherwise;
  if (then == condition) then = kTrue;
  if (otherwise == condition) otherwise = kFalse;
  if (then == otherwise) return then;
  if (then == kTrue && otherwise == kFalse) return condition;
  // And, or: the same whichever side comes first.
  if (otherwise == kFalse && then < condition) std::swap(then, condition);
  if (then == kTrue && otherwise < condition) std::swap(otherwise, condition);
  const Answer& known = answer_of(asked);
  return known.asked == asked ? std::optional(known.answer) : std::nullopt;
}

Diagram::Question Diagram::part(const Question& of, std::uint32_t top, bool value) const {
  const auto of_node = [&](Node node) { return level(node) != top ? node : value ? high(node) : low(node); };
  return {of_node(of.condition), of_node(of.otherwise), of_node(of.then)};
}

// Shannon's expansion. A list of open questions takes the place of recursion: there are as many levels as a
// formula has parts.
Diagram::Node Diagram::choose(Node condition, Node then, Node otherwise) {
  open_.clear();
  Question asked{condition, otherwise, then};
  for (std::size_t steps = 0; !exhausted_;) {
    std::optional<Node> answer = at_once(asked);
    if (!answer) {
      const std::uint32_t top = std::min({level(asked.condition), level(asked.then), level(asked.otherwise)});
      exhausted_ = ++steps > kMostStepsPerNode * most_;
      open_.push_back({asked, top, std::nullopt});
      asked = part(asked, top, false);
      continue;
    }
    for (; !open_.empty() && open_.back().low; open_.pop_back()) {
      answer = make(open_.back().top, *open_.back().low, *answer);
      if (!exhausted_) answer_of(open_.back().question) = {open_.back().question, *answer};
    }
    if (open_.empty()) return *answer;
    open_.back().low = answer;
    asked = part(open_.back().question, open_.back().top, true);
  }
  return kFalse;
}

}  // namespace stepwright::ltl
