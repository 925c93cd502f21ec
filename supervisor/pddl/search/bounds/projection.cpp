#include "supervisor/pddl/search/bounds/projection.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace stepwright::pddl {

Projection::Projection(const StateSpace& space, Pattern pattern)
    : space_(&space),
      pattern_(std::move(pattern)),
      fact_words_((pattern_.facts.size() + 63) / 64),
      fact_place_(space.task().facts.size(), -1),
      variable_place_(space.task().variables.size(), -1),
      nodes_(fact_words_ + pattern_.variables.size()),
      key_(fact_words_ + pattern_.variables.size()) {
  for (std::size_t i = 0; i < pattern_.facts.size(); ++i) {
    fact_place_[static_cast<std::size_t>(pattern_.facts[i])] = static_cast<int>(i);
  }
  for (std::size_t i = 0; i < pattern_.variables.size(); ++i) {
    variable_place_[static_cast<std::size_t>(pattern_.variables[i])] = static_cast<int>(i);
  }
  relaxed_.literals.assign(2 * space.task().facts.size(), true);
  relaxed_.values = space.task().bounds;
  for (std::size_t i = 0; i < space.task().operators.size(); ++i) {
    if (relevant(space.task().operators[i])) operators_.push_back(static_cast<int>(i));
  }
}

bool Projection::relevant(const GroundOperator& op) const {
  const auto in_pattern = [this](int fact) { return fact_place_[static_cast<std::size_t>(fact)] >= 0; };
  return std::any_of(op.effects.begin(), op.effects.end(), [&](const GroundEffect& effect) {
    return std::any_of(effect.adds.begin(), effect.adds.end(), in_pattern) ||
           std::any_of(effect.deletes.begin(), effect.deletes.end(), in_pattern) ||
           std::any_of(effect.numeric.begin(), effect.numeric.end(), [&](const NumericEffect& n) {
             return variable_place_[static_cast<std::size_t>(n.variable)] >= 0;
           });
  });
}

std::optional<Projection> Projection::build(const StateSpace& space, Pattern pattern, std::size_t most_states,
                                            std::size_t most_work) {
  Projection projection(space, std::move(pattern));
  if (!projection.explore(most_states, most_work)) return std::nullopt;
  return projection;
}

std::uint32_t Projection::find(const Word* state) const {
  std::fill(key_.begin(), key_.end(), 0);
  for (std::size_t i = 0; i < pattern_.facts.size(); ++i) {
    if (space_->fact(state, pattern_.facts[i])) key_[i >> 6] |= Word{1} << (i & 63);
  }
  for (std::size_t i = 0; i < pattern_.variables.size(); ++i) {
    key_[fact_words_ + i] = std::bit_cast<Word>(space_->value(state, pattern_.variables[i]));
  }
  return nodes_.find(key_.data());
}

double Projection::value_of(const Word* projected, std::size_t place) const {
  return std::bit_cast<double>(projected[fact_words_ + place]);
}

void Projection::unpack(const Word* projected) {
  for (std::size_t i = 0; i < pattern_.facts.size(); ++i) {
    const bool holds = (projected[i >> 6] >> (i & 63) & 1) != 0;
    const auto literal = 2 * static_cast<std::size_t>(pattern_.facts[i]);
    relaxed_.literals[literal] = holds;
    relaxed_.literals[literal + 1] = !holds;
  }
  for (std::size_t i = 0; i < pattern_.variables.size(); ++i) {
    const double value = value_of(projected, i);
    relaxed_.values[static_cast<std::size_t>(pattern_.variables[i])] =
        value == value ? Interval::point(value) : Interval{};
  }
}

// Does the condition look at the pattern only, so that "can hold" means "holds"?
bool Projection::certain(const Condition& condition) const {
  for (const int literal : condition.literals) {
    if (fact_place_[static_cast<std::size_t>(literal / 2)] < 0) return false;
  }
  bool inside = true;
  for (const Comparison& comparison : condition.comparisons) {
    for_each_variable(comparison.difference,
                      [&](int v) { inside = inside && variable_place_[static_cast<std::size_t>(v)] >= 0; });
  }
  return inside && std::all_of(condition.choices.begin(), condition.choices.end(), [&](const auto& options) {
           return std::all_of(options.begin(), options.end(), [&](const Condition& o) { return certain(o); });
         });
}

// What the effect does but for the facts that it adds. False if a variable of the pattern gets a value that
// is not known here.
bool Projection::apply(const GroundEffect& effect, std::vector<Word>& state) const {
  for (const NumericEffect& numeric : effect.numeric) {
    const int place = variable_place_[static_cast<std::size_t>(numeric.variable)];
    if (place < 0) continue;
    const Interval result = evaluate_interval(result_of(numeric), relaxed_.values);
    if (result.empty() || !(result.low == result.high)) return false;
    // Several changes of one variable add up; the difference to the state before is what each contributes.
    Word& word = state[fact_words_ + static_cast<std::size_t>(place)];
    const Interval before = relaxed_.values[static_cast<std::size_t>(numeric.variable)];
    const double now = std::bit_cast<double>(word);
    const bool replace = numeric.kind == ChangeKind::Assign || before.empty();
    word = std::bit_cast<Word>(snap(replace ? result.low : now + (result.low - before.low)));
  }
  for (const int fact : effect.deletes) {
    if (const int place = fact_place_[static_cast<std::size_t>(fact)]; place >= 0) {
      state[static_cast<std::size_t>(place) >> 6] &= ~(Word{1} << (place & 63));
    }
  }
  return true;
}

// The adds of every effect win over the deletes of all.
void Projection::add_facts(std::vector<Word>& state) const {
  for (const GroundEffect* effect : fired_) {
    for (const int fact : effect->adds) {
      if (const int place = fact_place_[static_cast<std::size_t>(fact)]; place >= 0) {
        state[static_cast<std::size_t>(place) >> 6] |= Word{1} << (place & 63);
      }
    }
  }
}

// An effect whose condition is not decided by the pattern happens in one branch and not in the other.
bool Projection::branch(const GroundOperator& op, std::size_t effect, std::vector<Word> state, double cost,
                        std::uint32_t from, std::int32_t index) {
  if (effect == op.effects.size()) {
    add_facts(state);
    const auto [to, added] = nodes_.insert(state.data());
    if (to != from) transitions_.push_back({from, to, index, std::max(cost, op.cost.low)});
    return true;
  }
  const GroundEffect& next = op.effects[effect];
  const bool possible_here = can_hold(next.when, relaxed_);
  const bool sure = next.when.always() || (possible_here && certain(next.when));
  if (!sure && !branch(op, effect + 1, state, cost, from, index)) return false;
  if (!possible_here) return true;
  const double low = evaluate_interval(next.cost, relaxed_.values).low;
  if (!apply(next, state)) return false;
  fired_.push_back(&next);
  const bool known = branch(op, effect + 1, std::move(state), cost + low, from, index);
  fired_.pop_back();
  return known;
}

bool Projection::expand(std::uint32_t node) {
  unpack(nodes_.state(node));
  if (can_hold(space_->task().goal, relaxed_)) goals_.push_back(node);
  for (const int i : operators_) {
    const GroundOperator& op = space_->task().operators[static_cast<std::size_t>(i)];
    if (!can_hold(op.precondition, relaxed_)) continue;
    const Word* from = nodes_.state(node);
    // More branching than this is not worth its table.
    if (op.effects.size() > 6) return false;
    if (!branch(op, 0, {from, from + key_.size()}, 0.0, node, i)) return false;
  }
  return true;
}

bool Projection::explore(std::size_t most_states, std::size_t most_work) {
  const std::vector<Word> initial = space_->initial();
  find(initial.data());
  nodes_.insert(key_.data());
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
    if (nodes_.size() > most_states || node * operators_.size() > most_work || !expand(node)) return false;
  }
  return true;
}

std::vector<double> Projection::distances(const std::function<double(int, double)>& weight) const {
  // Incoming transitions of every node, as ranges of one sorted list.
  std::vector<std::uint32_t> first(nodes_.size() + 2, 0);
  for (const Transition& t : transitions_) ++first[t.to + 2];
  for (std::size_t i = 2; i < first.size(); ++i) first[i] += first[i - 1];
  std::vector<std::uint32_t> incoming(transitions_.size());
  for (std::uint32_t t = 0; t < transitions_.size(); ++t) incoming[first[transitions_[t].to + 1]++] = t;

  std::vector<double> distance(nodes_.size(), kInfinity);
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (const std::uint32_t goal : goals_) {
    distance[goal] = 0.0;
    open.emplace(0.0, goal);
  }
  while (!open.empty()) {
    const auto [d, node] = open.top();
    open.pop();
    if (d > distance[node]) continue;
    for (std::uint32_t k = first[node]; k < first[node + 1]; ++k) {
      const Transition& t = transitions_[incoming[k]];
      const double through = d + weight(t.op, t.cost);
      if (through >= distance[t.from]) continue;
      distance[t.from] = through;
      open.emplace(through, t.from);
    }
  }
  return distance;
}

}  // namespace stepwright::pddl
