#include "supervisor/pddl/search/lp/lp_fact_rows.h"

#include <algorithm>

namespace stepwright::pddl {
namespace {

// `stop` is asked after so many operators.
constexpr std::size_t kPause = 64;

// What an operator may and must do to one fact.
struct Touch {
  bool adds = false, may_add = false, deletes = false, may_delete = false;
};

class Builder {
 public:
  explicit Builder(const RelaxedTask& task)
      : task_(task), domains_(task.space().domains()), ground_(task.space().task()) {
    const auto literals = 2 * static_cast<std::size_t>(ground_.first_derived);
    entries_.resize(literals);
  }

  // False if stopped: a row that lacks operators would say too much.
  bool collect(const std::function<bool()>& stop) {
    for (std::size_t op = 0; op < ground_.operators.size(); ++op) {
      if (op % kPause == 0 && stop()) return false;
      add(static_cast<int>(op));
    }
    return true;
  }

  std::vector<FactRow> rows() {
    const Implied goal = implied_by(ground_.goal);
    std::vector<FactRow> list;
    for (std::size_t l = 0; l < entries_.size(); ++l) {
      const int literal = static_cast<int>(l);
      const bool wanted = goal.holds(literal);
      if (literal % 2 == 1 && task_.atom_of_literal(literal) < 0) continue;
      const bool falls = std::any_of(entries_[l].begin(), entries_[l].end(),
                                     [](const LpEntry& entry) { return entry.coefficient < 0.0; });
      if (wanted || falls) list.push_back({literal, wanted, {std::move(entries_[l]), 0.0}});
    }
    return list;
  }

 private:
  // The literals that a condition says, and the facts that exclude theirs.
  struct Implied {
    std::vector<int> literals;  // ascending
    std::vector<int> groups;    // finite-domain variables of its facts, ascending
    const FiniteDomains* domains;

    bool holds(int literal) const {
      if (std::binary_search(literals.begin(), literals.end(), literal)) return true;
      return literal % 2 == 1 &&
             std::binary_search(groups.begin(), groups.end(), domains->variable_of(literal / 2)) &&
             !std::binary_search(literals.begin(), literals.end(), literal - 1);
    }
  };

  Implied implied_by(const Condition& condition) const {
    Implied implied{condition.literals, {}, &domains_};
    std::sort(implied.literals.begin(), implied.literals.end());
    for (const int literal : implied.literals) {
      if (literal % 2 == 0) implied.groups.push_back(domains_.variable_of(literal / 2));
    }
    std::sort(implied.groups.begin(), implied.groups.end());
    return implied;
  }

  void add(int index) {
    const GroundOperator& op = ground_.operators[static_cast<std::size_t>(index)];
    const Implied before = implied_by(op.precondition);
    touched_.clear();
    for (const GroundEffect& effect : op.effects) {
      if (effect.when.impossible) continue;
      const bool always = effect.when.always();
      for (const int fact : effect.adds) {
        Touch& touch = touch_of(fact);
        (always ? touch.adds : touch.may_add) = true;
      }
      for (const int fact : effect.deletes) {
        Touch& touch = touch_of(fact);
        (always ? touch.deletes : touch.may_delete) = true;
      }
    }
    for (const auto& [fact, touch] : touched_) {
      enter(2 * fact, index, most_gain(touch, before.holds(2 * fact)));
      enter(2 * fact + 1, index, most_loss(touch, before.holds(2 * fact + 1)));
    }
  }

  Touch& touch_of(int fact) {
    for (auto& [known, touch] : touched_) {
      if (known == fact) return touch;
    }
    return touched_.emplace_back(fact, Touch{}).second;
  }

  // The largest change of a fact's truth; adds win over deletes.
  static double most_gain(const Touch& touch, bool was_true) {
    if (touch.adds || touch.may_add) return was_true ? 0.0 : 1.0;
    return touch.deletes && was_true ? -1.0 : 0.0;
  }

  // The largest change of its falsehood.
  static double most_loss(const Touch& touch, bool was_false) {
    if (touch.adds) return was_false ? -1.0 : 0.0;
    return (touch.deletes || touch.may_delete) && !was_false ? 1.0 : 0.0;
  }

  void enter(int literal, int op, double change) {
    if (change != 0.0) entries_[static_cast<std::size_t>(literal)].push_back({op, change});
  }

  const RelaxedTask& task_;
  const FiniteDomains& domains_;
  const GroundTask& ground_;
  std::vector<std::vector<LpEntry>> entries_;  // by literal
  std::vector<std::pair<int, Touch>> touched_;
};

}  // namespace

std::vector<FactRow> fact_rows(const RelaxedTask& task, const std::function<bool()>& stop) {
  Builder builder(task);
  if (!builder.collect(stop)) return {};
  return builder.rows();
}

}  // namespace stepwright::pddl
