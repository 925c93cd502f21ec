#include "supervisor/pddl/search/pruning/dominance.h"

#include <algorithm>
#include <cmath>

#include "runtime/base/hash64.h"
#include "supervisor/pddl/search/space/gentle_growth.h"
#include "supervisor/pddl/search/space/integer_ranges.h"

namespace stepwright::pddl {
namespace {

constexpr std::uint32_t kEnd = UINT32_MAX;

// Who asks for what of each variable.
class Preferences {
 public:
  explicit Preferences(const GroundTask& task)
      : task_(task),
        integers_(integer_variables(task)),
        more_(task.variables.size(), false),
        less_(task.variables.size(), false) {}

  std::vector<Preference> find() {
    ask(task_.goal, nullptr);
    read(task_.potential);
    for (const GroundAxiom& axiom : task_.axioms) read(axiom.body);
    for (const GroundOperator& op : task_.operators) {
      ask(op.precondition, &op);
      for (const GroundEffect& effect : op.effects) read(effect);
    }
    std::vector<Preference> list;
    for (std::size_t v = 0; v < more_.size(); ++v) {
      list.push_back(more_[v] == less_[v] ? Preference::Exact
                     : more_[v]           ? Preference::More
                                          : Preference::Less);
    }
    return list;
  }

 private:
  // Whatever reads the variable wants it as it is.
  void exact(int variable) {
    more_[static_cast<std::size_t>(variable)] = true;
    less_[static_cast<std::size_t>(variable)] = true;
  }
  void read(const GroundExpression& expression) {
    for_each_variable(expression, [this](int v) { exact(v); });
  }
  void read(const Condition& condition) {
    for (const Comparison& comparison : condition.comparisons) read(comparison.difference);
    for (const auto& options : condition.choices) {
      for (const Condition& option : options) read(option);
    }
  }
  void read(const GroundEffect& effect) {
    read(effect.when);
    read(effect.cost);
    for (const NumericEffect& numeric : effect.numeric) {
      read(numeric.amount);
      const bool scaled = numeric.kind == ChangeKind::ScaleUp || numeric.kind == ChangeKind::ScaleDown;
      if (scaled) exact(numeric.variable);
    }
  }

  // `op`: whose precondition it is, if all of it must hold.
  void ask(const Condition& condition, const GroundOperator* op) {
    for (const Comparison& comparison : condition.comparisons) ask(comparison, op);
    for (const auto& options : condition.choices) {
      for (const Condition& option : options) ask(option, nullptr);
    }
  }
  void ask(const Comparison& comparison, const GroundOperator* op) {
    if (!comparison.difference.linear() || comparison.relation == Relation::Equal) {
      return read(comparison.difference);
    }
    const bool grows =
        comparison.relation == Relation::Greater || comparison.relation == Relation::GreaterEqual;
    for (const LinearTerm& term : comparison.difference.terms) {
      const bool more = grows == (term.coefficient > 0.0);
      if (op != nullptr && needless_once_full(*op, comparison, more)) continue;
      (more ? more_ : less_)[static_cast<std::size_t>(term.variable)] = true;
    }
  }

  // Does the operator only set the variable of the comparison to a constant, which it is already past where
  // the comparison does not hold? `more`: the comparison asks for more of it.
  bool needless_once_full(const GroundOperator& op, const Comparison& comparison, bool more) const {
    if (comparison.difference.terms.size() != 1) return false;
    const LinearTerm& term = comparison.difference.terms.front();
    // Integers, so that the tolerance of comparisons is not in the way.
    if (!integers_[static_cast<std::size_t>(term.variable)]) return false;
    const double end = -comparison.difference.constant / term.coefficient;
    return std::all_of(op.effects.begin(), op.effects.end(), [&](const GroundEffect& effect) {
      return effect.adds.empty() && effect.deletes.empty() &&
             std::all_of(effect.numeric.begin(), effect.numeric.end(), [&](const NumericEffect& numeric) {
               if (numeric.variable != term.variable || numeric.kind != ChangeKind::Assign ||
                   !numeric.amount.is_constant())
                 return false;
               const double full = numeric.amount.constant;
               return more ? end <= full : end >= full;
             });
    });
  }

  const GroundTask& task_;
  const std::vector<bool> integers_;
  std::vector<bool> more_, less_;  // somebody asks for more, for less
};

}  // namespace

std::vector<Preference> preferences(const GroundTask& task) {
  return Preferences(task).find();
}

Dominance::Dominance(const StateSpace& space)
    : objects_(space),
      symmetric_(!objects_.none()),
      is_resource_(space.words(), false),
      asked_(space.words()),
      other_(space.words()) {
  const std::vector<Preference> preferred = preferences(space.task());
  // Which fluents are integers depends on the initial state, and so may what is preferred.
  for (const auto& [a, b] : objects_.exchanged_variables()) {
    if (preferred[static_cast<std::size_t>(a)] != preferred[static_cast<std::size_t>(b)]) symmetric_ = false;
  }
  for (std::size_t v = 0; v < preferred.size(); ++v) {
    if (preferred[v] == Preference::Exact) continue;
    resources_.push_back({space.fact_words() + v, static_cast<double>(preferred[v])});
    is_resource_[resources_.back().word] = true;
  }
}

std::uint64_t Dominance::hash_of_rest(const Word* state) const {
  std::uint64_t hash = 0;
  for (std::size_t w = 0; w < is_resource_.size(); ++w) {
    if (!is_resource_[w]) hash = base::hash_mix(hash, state[w]);
  }
  return hash;
}

bool Dominance::same_rest(const Word* a, const Word* b) const {
  for (std::size_t w = 0; w < is_resource_.size(); ++w) {
    if (!is_resource_[w] && a[w] != b[w]) return false;
  }
  return true;
}

// An amount that is not defined is enough for nothing.
bool Dominance::enough(std::size_t entry, const Word* state) const {
  for (std::size_t r = 0; r < resources_.size(); ++r) {
    const double wanted = resources_[r].sign * std::bit_cast<double>(state[resources_[r].word]);
    if (!(amounts_[entry * resources_.size() + r] >= wanted)) return false;
  }
  return true;
}

bool Dominance::as_much(std::size_t entry, const Word* state) const {
  for (std::size_t r = 0; r < resources_.size(); ++r) {
    const double amount = resources_[r].sign * std::bit_cast<double>(state[resources_[r].word]);
    if (amounts_[entry * resources_.size() + r] != amount) return false;
  }
  return true;
}

bool Dominance::prunes(std::uint32_t node, const Word* state, const StateTable& nodes) {
  std::copy(state, state + asked_.size(), asked_.begin());
  if (symmetric_) objects_.arrange(asked_.data());
  std::uint32_t& head = heads_.try_emplace(hash_of_rest(asked_.data()), kEnd).first->second;
  const Node& asked = nodes[node];
  bool known = false;
  for (std::uint32_t e = head; e != kEnd; e = entries_[e].next) {
    if (entries_[e].node == node) {
      known = true;
      continue;
    }
    const Node& other = nodes[entries_[e].node];
    if (other.cost > asked.cost || (other.cost == asked.cost && other.steps > asked.steps)) continue;
    if (!enough(e, asked_.data())) continue;
    // Of two that are as good as each other, the older one stays.
    const bool equal = other.cost == asked.cost && other.steps == asked.steps && as_much(e, asked_.data());
    if (equal && entries_[e].node > node) continue;
    nodes.load(entries_[e].node, other_.data());
    if (symmetric_) objects_.arrange(other_.data());
    if (same_rest(other_.data(), asked_.data())) return true;
  }
  if (known) return false;
  push_gently(entries_, Entry{node, head});
  head = static_cast<std::uint32_t>(entries_.size()) - 1;
  for (const Resource& resource : resources_) {
    push_gently(amounts_, resource.sign * std::bit_cast<double>(asked_[resource.word]));
  }
  return false;
}

std::size_t Dominance::memory() const {
  constexpr std::size_t kHead = 4 * sizeof(void*);
  return heads_.size() * kHead + heads_.bucket_count() * sizeof(void*) + entries_.capacity() * sizeof(Entry) +
         amounts_.capacity() * sizeof(double);
}

}  // namespace stepwright::pddl
