#include "supervisor/htn/search/search.h"

#include <algorithm>

#include "supervisor/htn/search/search_engine.h"

namespace stepwright::htn {

using model::OutcomeKind;

namespace {

constexpr int kFirstExcess = 4;  // tasks by which a network may outgrow the problem's in the first stage

}  // namespace

Search::Search(const PlanningTask& task, SearchOptions options, SemanticAttachment* attachment)
    : implementation_(std::make_unique<Implementation>(task, options, attachment)) {}

Search::~Search() = default;

SearchOutcome Search::next() {
  return implementation_->next();
}

void Search::reject(std::size_t keep, bool proven) {
  implementation_->reject(keep, proven);
}

void Search::extend(std::optional<std::chrono::steady_clock::time_point> until) {
  implementation_->extend(until);
}

void Search::retry_unproven() {
  implementation_->retry_unproven();
}

const SearchStatistics& Search::statistics() const {
  return implementation_->statistics();
}

Search::Implementation::Implementation(const PlanningTask& task, SearchOptions options,
                                       SemanticAttachment* attachment)
    : task_(task),
      options_(options),
      attachment_(attachment),
      state_(task),
      interrupt_(options.until, options.cancel),
      actions_(task, state_, interrupt_),
      height_(network_height(task)) {
  for (const Method& method : task.methods) tests_.push_back(tests_of(task, method));
}

void Search::Implementation::extend(std::optional<std::chrono::steady_clock::time_point> until) {
  options_.until = until;
  interrupt_ = Interrupt(until, options_.cancel);
}

void Search::Implementation::take_back(std::size_t actions) {
  while (applied_.size() > actions) {
    if (attachment_ != nullptr) attachment_->pop();
    applied_.pop_back();
  }
}

// A stage with a bound that no stage before it had; false if there is none.
bool Search::Implementation::begin_stage() {
  const bool first = statistics_.stages == 0;
  if (!first && (!cut_ || bound_ >= options_.most_pending)) return false;
  if (first) {
    excess_ = height_.growing ? kFirstExcess : options_.most_pending;
  } else {
    excess_ += excess_ / 2;
  }
  bound_ = std::min(height_.most, options_.most_pending - excess_) + excess_;
  ++statistics_.stages;
  cut_ = given_up_ = false;
  nodes_.clear();
  take_back(0);
  state_.undo(0);
  depth_ = 0;
  const auto root = static_cast<int>(task_.actions.size() + task_.tasks.size()) - 1;
  running_ = open(agenda_.push(tuples_.intern(root, {}), Agenda::kEmpty)) == Step::Opened;
  return true;
}

SearchOutcome Search::Implementation::next() {
  interrupt_.look();
  while (!full_) {
    if (!running_ && !begin_stage()) break;
    if (run()) return {OutcomeKind::Solved, build_plan(), ""};
    if (interrupt_.stopped() || full_) break;
    running_ = false;
  }
  return ended();
}

// True with a plan; false when the stage is over or the search has to end.
bool Search::Implementation::run() {
  while (depth_ > 0) {
    if (interrupt_.poll()) return false;
    if (nodes_.size() > options_.most_nodes) {
      full_ = true;
      return false;
    }
    Frame& frame = frames_[depth_ - 1];
    take_back(frame.actions);
    state_.undo(frame.mark);
    const std::size_t depth = depth_;
    if (!choose(frame)) {
      if (interrupt_.stopped()) return false;
      if (depth_ == depth) close();  // else the attachment sent the search back
      continue;
    }
    ++statistics_.decompositions;
    const Step step = advance(frame.chosen);  // frames may move
    if (interrupt_.stopped()) {
      // What was evaluated meanwhile means nothing.
      if (depth_ > depth) settle(frames_[--depth_], NodeStatus::Unknown, 0);
      try_again(frames_[depth_ - 1]);
      return false;
    }
    if (step != Step::Found) continue;
    frames_[depth_ - 1].solved = true;
    if (is_new_plan()) return true;
  }
  return false;
}

// The method under way is begun anew when the search goes on.
void Search::Implementation::try_again(Frame& frame) {
  if (frame.method > 0) --frame.method;
  frame.walking = false;
}

// The next way to decompose the frame's task.
bool Search::Implementation::choose(Frame& frame) {
  const std::size_t actions = task_.actions.size();
  const auto& methods = task_.tasks[static_cast<std::size_t>(tuples_.head(frame.task)) - actions].methods;
  while (true) {
    bool next = false;
    if (!frame.walking) {
      if (frame.method == methods.size()) break;
      const int number = methods[frame.method++];
      const Method& method = task_.methods[static_cast<std::size_t>(number)];
      frame.chosen_method = number;
      frame.chosen = Agenda::kEmpty - 1;
      frame.walking = frame.walk.start(method, tests_[static_cast<std::size_t>(number)],
                                       tuples_.objects(frame.task), state_, evaluation());
    } else {
      frame.walking = frame.walk.next(state_, evaluation());
      next = frame.walking;
    }
    if (interrupt_.stopped()) {
      try_again(frame);
      return false;
    }
    if (!next) continue;
    const std::size_t depth = depth_;
    if (use_method(frame, task_.methods[static_cast<std::size_t>(frame.chosen_method)])) return true;
    if (depth_ != depth) return false;
  }
  if (!frame.tried) note_obstacle(frame.task, "");
  return false;
}

// Puts the subtasks in front of what is still to be done. Variables that no subtask has make no difference.
bool Search::Implementation::use_method(Frame& frame, const Method& method) {
  int network = agenda_.rest(frame.network);
  for (std::size_t i = method.subtasks.size(); i-- > 0;) {
    const Subtask& subtask = method.subtasks[i];
    row_.clear();
    for (const Term term : subtask.terms) row_.push_back(object_of(term, frame.walk.binding()));
    const auto head =
        subtask.primitive ? subtask.symbol : subtask.symbol + static_cast<int>(task_.actions.size());
    network = agenda_.push(tuples_.intern(head, row_), network);
  }
  if (network == frame.chosen) return false;
  if (ask(method.external_conditions, frame.walk.binding(), false, applied_.size(), nullptr) != Step::Opened)
    return false;
  frame.chosen = network;
  frame.tried = true;
  return true;
}

// Applies actions up to the next compound task.
Search::Implementation::Step Search::Implementation::advance(int network) {
  while (network != Agenda::kEmpty && is_action(agenda_.task(network))) {
    const Step step = act(agenda_.task(network));
    if (step != Step::Opened) return step;
    network = agenda_.rest(network);
  }
  return network == Agenda::kEmpty ? finish() : open(network);
}

Search::Implementation::Step Search::Implementation::act(int ground) {
  const GroundAction& action = actions_.get(ground, tuples_.head(ground), tuples_.objects(ground));
  if (!actions_.applicable(action)) {
    ++statistics_.refused_actions;
    if (farthest_.ground < 0 || applied_.size() > farthest_.actions)
      note_obstacle(ground, actions_.obstacle(action));
    return Step::Failed;
  }
  const Fingerprint before = applied_.empty() ? Fingerprint{} : applied_.back().prefix;
  const Fingerprint prefix = followed_by(before, static_cast<std::uint64_t>(ground));
  if (is_nogood(prefix)) return Step::Failed;
  if (attachment_ != nullptr) {
    const Step step = act_outside(action, prefix);
    if (step != Step::Opened) return step;
  }
  actions_.apply(action);
  applied_.push_back({ground, prefix});
  ++statistics_.actions;
  return Step::Opened;
}

Search::Implementation::Step Search::Implementation::finish() {
  scratch_.assign(static_cast<std::size_t>(task_.goal_slots), -1);
  if (!holds(task_.goal, scratch_, evaluation())) {
    note_obstacle(-1, "the goal does not hold in the end");
    return Step::Failed;
  }
  const Step step = ask(task_.external_goals, scratch_, false, applied_.size(), nullptr);
  return step == Step::Opened ? Step::Found : step;
}

Fingerprint Search::Implementation::node_of(int network) const {
  Fingerprint node = followed_by(state_.fingerprint(), static_cast<std::uint64_t>(network) + 1);
  if (attachment_ == nullptr) return node;
  const auto outside = attachment_->fingerprint();
  return outside ? followed_by(followed_by(node, outside->high), outside->low) : node;
}

// A frame for the first task of the network, unless its node is known.
Search::Implementation::Step Search::Implementation::open(int network) {
  const int length = agenda_.length(network);
  statistics_.longest_network = std::max(statistics_.longest_network, length);
  if (length > bound_) {
    cut_ = true;
    return Step::Failed;
  }
  const Fingerprint node = node_of(network);
  if (depth_ > 0 && known(frames_[depth_ - 1], node)) return Step::Failed;
  nodes_.record(node) = {NodeStatus::Open, static_cast<std::uint32_t>(depth_)};
  if (depth_ == frames_.size()) frames_.emplace_back();
  Frame& frame = frames_[depth_];
  frame.network = network;
  frame.task = agenda_.task(network);
  frame.node = node;
  frame.mark = state_.mark();
  frame.actions = applied_.size();
  frame.method = 0;
  frame.walking = frame.tried = frame.solved = frame.given_up = frame.by_prefix = false;
  frame.lowest = static_cast<std::uint32_t>(depth_);
  frame.conditional.clear();
  ++depth_;
  return Step::Opened;
}

void Search::Implementation::note_obstacle(int ground, std::string obstacle) {
  if (!obstacle.empty() && (farthest_.obstacle.empty() || applied_.size() > farthest_.actions)) {
    farthest_ = {applied_.size(), ground, std::move(obstacle)};
  } else if (obstacle.empty() && (farthest_.ground < 0 || applied_.size() > farthest_.actions)) {
    farthest_ = {applied_.size(), ground, "no method can be applied"};
  }
}

std::string Search::Implementation::progress() const {
  if (farthest_.obstacle.empty()) return "";
  std::string text =
      "the farthest try, after " + std::to_string(farthest_.actions) + " action(s), ends where ";
  if (farthest_.ground < 0) return text + farthest_.obstacle;
  const int head = tuples_.head(farthest_.ground);
  const auto actions = static_cast<int>(task_.actions.size());
  const bool action = head < actions;
  text += "(" + (action ? task_.actions[static_cast<std::size_t>(head)].name
                        : task_.tasks[static_cast<std::size_t>(head - actions)].name);
  for (const int object : tuples_.objects(farthest_.ground))
    text += " " + task_.objects[static_cast<std::size_t>(object)].name;
  return text + ") " + (action ? "cannot be done: " : "has no further way: ") + farthest_.obstacle;
}

SearchOutcome Search::Implementation::ended() {
  const std::string more = progress().empty() ? "" : "; " + progress();
  if (interrupt_.cancelled()) return {OutcomeKind::Cancelled, std::nullopt, "cancelled" + more};
  if (interrupt_.stopped()) return {OutcomeKind::Exhausted, std::nullopt, "the time is up" + more};
  if (full_) return {OutcomeKind::Exhausted, std::nullopt, "too many nodes to remember" + more};
  if (cut_)
    return {OutcomeKind::Exhausted, std::nullopt,
            "no network of up to " + std::to_string(bound_) + " tasks leads to a plan" + more};
  if (given_up_)
    return {OutcomeKind::Exhausted, std::nullopt,
            "what was evaluated outside was given up without proof" + more};
  return {OutcomeKind::Infeasible, std::nullopt, "every decomposition was tried" + more};
}

}  // namespace stepwright::htn
