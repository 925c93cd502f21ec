// What the search has to do with a semantic attachment: conditions and effects that it is asked, prefixes
// that it refuses, and the way back to their cause.

#include <algorithm>
#include <cassert>

#include "supervisor/htn/search/search_engine.h"

namespace stepwright::htn {

bool Search::Implementation::is_nogood(const Fingerprint& prefix) {
  const auto found = nogoods_.find(prefix);
  if (found == nogoods_.end()) return false;
  Frame& frame = frames_[depth_ - 1];
  frame.given_up = frame.given_up || !found->second;
  frame.by_prefix = true;
  return true;
}

// Opened if all hold, or are changed. `prefix`: the actions before; `refused`: the prefix with the action
// that asks, if it is one.
Search::Implementation::Step Search::Implementation::ask(const std::vector<ExternalLiteral>& literals,
                                                         const std::vector<int>& binding, bool effects,
                                                         std::size_t prefix, const Fingerprint* refused) {
  if (attachment_ == nullptr) return Step::Opened;
  for (const ExternalLiteral& literal : literals) {
    std::vector<int> objects;
    for (const Term term : literal.terms) objects.push_back(object_of(term, binding));
    ++statistics_.external_calls;
    const ExternalCall call{literal.predicate, objects};
    const auto refusal =
        effects ? attachment_->change(call, literal.positive) : attachment_->require(call, literal.positive);
    if (!refusal) continue;
    ++statistics_.refusals;
    if (!refusal->reason.empty()) note_obstacle(-1, refusal->reason);
    return refuse(refusal->keep, refusal->proven, prefix, refused);
  }
  return Step::Opened;
}

Search::Implementation::Step Search::Implementation::refuse(std::size_t keep, bool proven, std::size_t prefix,
                                                            const Fingerprint* refused) {
  if (refused != nullptr) attachment_->pop();
  if (keep >= prefix) {
    if (refused != nullptr) nogoods_[*refused] = proven;
    if (!proven) frames_[depth_ - 1].given_up = true;
    return Step::Failed;
  }
  jump(keep, proven);
  return Step::Jumped;
}

Search::Implementation::Step Search::Implementation::act_outside(const GroundAction& action,
                                                                 const Fingerprint& prefix) {
  const Action& schema = *action.action;
  const auto number = static_cast<int>(&schema - task_.actions.data());
  attachment_->push({number, action.objects});
  scratch_.assign(static_cast<std::size_t>(schema.slots), -1);
  std::ranges::copy(action.objects, scratch_.begin());
  const Step step = ask(schema.external_conditions, scratch_, false, applied_.size(), &prefix);
  return step != Step::Opened ? step : ask(schema.external_effects, scratch_, true, applied_.size(), &prefix);
}

// Back to the frame whose choice brought the action behind the first `keep` ones: no plan begins with it.
void Search::Implementation::jump(std::size_t keep, bool proven) {
  assert(keep < applied_.size());
  ++statistics_.backjumps;
  nogoods_[applied_[keep].prefix] = proven;
  bool solved = false;
  while (frames_[depth_ - 1].actions > keep) {
    Frame& frame = frames_[--depth_];
    solved = solved || frame.solved;
    settle(frame, NodeStatus::Unknown, 0);
  }
  Frame& target = frames_[depth_ - 1];
  target.solved = target.solved || solved;
  target.given_up = target.given_up || !proven;
  target.by_prefix = true;
  take_back(target.actions);
  state_.undo(target.mark);
}

void Search::Implementation::reject(std::size_t keep, bool proven) {
  if (keep < applied_.size()) jump(keep, proven);
}

void Search::Implementation::retry_unproven() {
  std::erase_if(nogoods_, [](const auto& nogood) { return !nogood.second; });
  // From the first stage again: the dead ends of this one may hang on what was given up.
  statistics_.stages = 0;
  running_ = false;
  full_ = false;
}

}  // namespace stepwright::htn
