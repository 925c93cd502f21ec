#include "supervisor/pddl/search/engines/width_search.h"

#include <algorithm>
#include <functional>

#include "supervisor/pddl/search/control/plan_runner.h"

namespace stepwright::pddl {
namespace {

constexpr std::size_t kFilterBits = std::size_t{1} << 26;  // 8 MB
constexpr std::size_t kLongestSteps = 128;
// Of states with more values only single ones are looked at.
constexpr std::size_t kMostPaired = 1500;

std::uint64_t mix(std::uint64_t a, std::uint64_t b) {
  std::uint64_t h = (a ^ (b + 0x9e3779b97f4a7c15u + (a << 6) + (a >> 2))) * 0xff51afd7ed558ccdu;
  h ^= h >> 32;
  return h * 0xc4ceb9fe1a85ec53u;
}

}  // namespace

WidthSearch::WidthSearch(const RelaxedTask& task, SearchControl& control, const Landmarks& landmarks,
                         const Interchangeable* objects)
    : task_(task),
      space_(task.space()),
      control_(control),
      memory_(control),
      count_(task, landmarks, std::vector<int>(space_.task().operators.size(), 1)),
      additive_(task, unit_weights(space_.task())),
      nodes_(space_),
      reached_((landmarks.size() + 63) / 64),
      own_(kBits + kStepWords),
      seen_(kFilterBits / 64, 0),
      before_(space_.words()),
      state_(space_.words()) {
  if (objects != nullptr) exchanges_.emplace(space_, *objects);
  list_values(space_.initial().data(), usual_);
  for (std::size_t v = 0; v < usual_.size(); ++v) {
    if (v >= space_.domains().size() || space_.domains()[v].count > 1) usual_[v] = 0;
  }
}

std::size_t WidthSearch::bytes() const {
  return nodes_.memory() + reached_.memory() + own_.memory() + open_.capacity() * sizeof(Entry) +
         seen_.capacity() * sizeof(Word) + (exchanges_ ? exchanges_->memory() : 0);
}

// The values of the state's variables, each as one number; 0 for those that have none of their facts.
void WidthSearch::list_values(const Word* state, std::vector<std::uint64_t>& values) const {
  const FiniteDomains& domains = space_.domains();
  values.clear();
  for (std::size_t v = 0; v < domains.size(); ++v) {
    const int value = domains.value(state, v);
    const bool none = value < 0 || value >= domains[v].count;
    values.push_back(none ? 0 : mix(v + 1, static_cast<std::uint64_t>(value) + 1));
  }
  for (std::size_t n = 0; n < space_.task().variables.size(); ++n) {
    values.push_back(mix(domains.size() + n + 1, state[space_.fact_words() + n]));
  }
}

// True if it is new.
bool WidthSearch::see(std::uint64_t key) {
  ++looked_up_;
  const std::size_t place = key & (kFilterBits - 1);
  const Word mask = Word{1} << (place & 63);
  const bool fresh = (seen_[place >> 6] & mask) == 0;
  seen_[place >> 6] |= mask;
  return fresh;
}

// What the values of the state can make pairs with.
void WidthSearch::list_partners(const Word* own) {
  const std::uint64_t group = mix(own[kLeft] + 1, own[kDone] + 1);
  keys_.assign(values_.size(), 0);
  present_.clear();
  unusual_.clear();
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (values_[i] == 0) continue;
    keys_[i] = mix(group, values_[i]);
    present_.push_back(i);
    if (values_[i] != usual_[i]) unusual_.push_back(i);
  }
}

// Of the state in `state_`. Where nothing but the state has changed since its parent, only values that the
// parent had not can be new.
int WidthSearch::novelty(const Word* own, const Word* parent) {
  list_values(state_.data(), values_);
  list_partners(own);
  const bool same = parent != nullptr && parent[kLeft] == own[kLeft] && parent[kDone] == own[kDone];
  const auto changed = [&](std::size_t i) { return !same || values_[i] != values_before_[i]; };
  int least = 3;
  for (const std::size_t i : present_) {
    if (changed(i) && see(keys_[i])) least = 1;
  }
  if (values_.size() > kMostPaired) return least;
  for (const std::size_t i : present_) {
    if (!changed(i)) continue;
    for (const std::size_t j : values_[i] == usual_[i] ? unusual_ : present_) {
      if (j == i || (j < i && changed(j))) continue;
      if (see(mix(std::min(keys_[i], keys_[j]), std::max(keys_[i], keys_[j])))) least = std::min(least, 2);
    }
  }
  return least;
}

void WidthSearch::mark_done(Word* own) const {
  const std::vector<int>& facts = steps_[own[kSteps]].facts;
  for (std::size_t i = 0; i < facts.size(); ++i) {
    if (!space_.fact(state_.data(), facts[i])) continue;
    Word& word = own[kBits + (i >> 6)];
    const Word mask = Word{1} << (i & 63);
    own[kDone] += (word & mask) == 0 ? 1 : 0;
    word |= mask;
  }
}

// A relaxed plan from the state in `state_`. False if there is none.
bool WidthSearch::plan_steps(Word* own) {
  control_.count_expanded(1);
  if (exchanges_) exchanges_->look_at(state_.data());
  if (!additive_.evaluate(state_.data(), exchanges_ ? exchanges_->needless_facts() : nullptr)) return false;
  Steps steps;
  for (const AdditiveHeuristic::Use& use : additive_.plan()) {
    for (const GroundEffect& effect : space_.task().operators[static_cast<std::size_t>(use.op)].effects) {
      for (const int fact : effect.adds) {
        if (!space_.fact(state_.data(), fact)) steps.facts.push_back(fact);
      }
    }
  }
  std::sort(steps.facts.begin(), steps.facts.end());
  steps.facts.erase(std::unique(steps.facts.begin(), steps.facts.end()), steps.facts.end());
  if (steps.facts.size() > kLongestSteps) steps.facts.resize(kLongestSteps);
  own[kSteps] = steps_.size();
  own[kDone] = 0;
  std::fill_n(own + kBits, kStepWords, Word{0});
  steps_.push_back(std::move(steps));
  return true;
}

// A new node, its state in `state_`. False if the goal cannot be reached from it.
bool WidthSearch::meet(std::uint32_t node, std::uint32_t parent) {
  const Word* before = parent == kNoNode ? nullptr : own_[parent];
  Word* own = own_[node];
  Word* reached = reached_[node];
  if (before != nullptr) {
    std::copy_n(reached_[parent], count_.words(), reached);
    std::copy_n(before, kBits + kStepWords, own);
  }
  count_.progress(state_.data(), reached);
  own[kLeft] = static_cast<Word>(count_.estimate(state_.data(), reached));
  if (before == nullptr || own[kLeft] < before[kLeft]) {
    if (!plan_steps(own)) return false;
  } else {
    mark_done(own);
  }
  open_.push_back({novelty(own, before), static_cast<int>(own[kLeft]), order_++, node});
  std::push_heap(open_.begin(), open_.end(), std::greater<>());
  return true;
}

void WidthSearch::expand(std::uint32_t node) {
  control_.count_expanded(1);
  nodes_.load(node, before_.data());
  list_values(before_.data(), values_before_);
  space_.applicable(before_.data(), applicable_);
  if (exchanges_) {
    exchanges_->look_at(before_.data());
    exchanges_->leave_out(applicable_);
  }
  for (const int op : applicable_) {
    if (control_.check() != StopReason::None) return;  // one state can take milliseconds
    double cost = 0.0;
    if (!space_.apply(op, before_.data(), state_.data(), cost)) continue;
    const auto [child, added] = nodes_.insert(state_.data());
    if (!added || (exchanges_ && !exchanges_->meet(state_.data()))) continue;
    ++met_;
    nodes_[child] = {snap(nodes_[node].cost + cost), node, op, nodes_[node].steps + 1, false};
    if (space_.goal(state_.data())) {
      found_ = offer_plan(space_, control_, nodes_.path(child)) || found_;
      if (found_) return;
    }
    meet(child, node);
  }
}

SearchStatus WidthSearch::run(std::uint64_t states, StopReason& reason) {
  if (!started_) {
    started_ = true;
    state_ = space_.initial();
    const std::uint32_t root = nodes_.insert(state_.data()).first;
    if (exchanges_) (void)exchanges_->meet(state_.data());
    if (space_.goal(state_.data())) found_ = offer_plan(space_, control_, {});
    if (!meet(root, kNoNode)) return SearchStatus::Exhausted;
  }
  constexpr std::uint64_t kMetPerState = 8;
  const std::uint64_t last = met_ + kMetPerState * states;
  while (!found_ && met_ < last) {
    memory_.set(bytes());
    if ((reason = control_.check()) != StopReason::None) return SearchStatus::Stopped;
    if (open_.empty()) return SearchStatus::Exhausted;
    std::pop_heap(open_.begin(), open_.end(), std::greater<>());
    const std::uint32_t node = open_.back().node;
    open_.pop_back();
    met_ += kMetPerState;
    expand(node);
  }
  return found_ ? SearchStatus::Found : SearchStatus::Running;
}

}  // namespace stepwright::pddl
