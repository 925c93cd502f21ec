#include "supervisor/pddl/search/relaxation/relaxed_task.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "supervisor/pddl/ground_task/relaxed_bounds.h"
#include "supervisor/pddl/search/relaxation/comparison_table.h"

namespace stepwright::pddl {
namespace {

void sort_out(std::vector<int>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

// What the effect adds to its variable, as an expression of the state before.
GroundExpression change_of(const NumericEffect& effect) {
  return combine(NumericKind::Subtract, result_of(effect), variable_expression(effect.variable));
}

}  // namespace

Gap gap_of(Relation relation, double difference) {
  if (!(difference == difference)) return {kInfinity, true};
  const bool up = relation == Relation::Greater || relation == Relation::GreaterEqual ||
                  (relation == Relation::Equal && difference < 0.0);
  const bool strict = relation == Relation::Greater || relation == Relation::Less;
  return {std::max(0.0, up ? -difference : difference) + (strict ? 1e-9 : 0.0), up};
}

// First every condition is numbered as atoms, then the units are collected, then the lists are turned around.
class RelaxedTaskBuilder {
 public:
  explicit RelaxedTaskBuilder(RelaxedTask& result)
      : result_(result), space_(result.space_), task_(space_.task()), comparisons_(task_.variables.size()) {}

  void build() {
    number_atoms();
    for (std::size_t i = 0; i < task_.operators.size(); ++i) add_operator(static_cast<int>(i));
    for (const GroundAxiom& axiom : task_.axioms) add_axiom(axiom);
    result_.goal_ = atoms_of(task_.goal);
    sort_out(result_.goal_);
    result_.atoms_ = choice_base_ + choices_.size();
    finish();
  }

 private:
  // Choices are numbered as they come up, behind all literals and comparisons: these are numbered first.
  void number_atoms() {
    result_.atom_of_literal_.assign(2 * task_.facts.size(), -1);
    result_.asked_true_.assign(space_.fact_words(), 0);
    result_.asked_false_.assign(space_.fact_words(), 0);
    number(task_.goal);
    for (const GroundOperator& op : task_.operators) {
      number(op.precondition);
      for (const GroundEffect& effect : op.effects) number(effect.when);
    }
    for (const GroundAxiom& axiom : task_.axioms) number(axiom.body);
    result_.derived_.assign(space_.fact_words(), 0);
    for (int fact = task_.first_derived; fact < static_cast<int>(task_.facts.size()); ++fact) {
      result_.derived_[static_cast<std::size_t>(fact) >> 6] |= Word{1} << (fact & 63);
    }
    result_.first_comparison_ = result_.literals_.size();
    result_.comparisons_ = comparisons_.list();
    choice_base_ = result_.first_comparison_ + result_.comparisons_.size();
  }

  void number(const Condition& condition) {
    for (const int literal : condition.literals) {
      int& atom = result_.atom_of_literal_[static_cast<std::size_t>(literal)];
      if (atom >= 0) continue;
      atom = static_cast<int>(result_.literals_.size());
      result_.literals_.push_back(literal);
      auto& asked = literal % 2 == 0 ? result_.asked_true_ : result_.asked_false_;
      asked[static_cast<std::size_t>(literal / 2) >> 6] |= Word{1} << (literal / 2 & 63);
    }
    for (const Comparison& comparison : condition.comparisons) comparisons_.add(comparison);
    for (const auto& options : condition.choices) {
      for (const Condition& option : options) number(option);
    }
  }

  std::vector<int> atoms_of(const Condition& condition) {
    std::vector<int> atoms;
    for (const int literal : condition.literals) {
      atoms.push_back(result_.atom_of_literal_[static_cast<std::size_t>(literal)]);
    }
    for (const Comparison& comparison : condition.comparisons) {
      atoms.push_back(static_cast<int>(result_.first_comparison_) + comparisons_.add(comparison));
    }
    for (const auto& options : condition.choices) atoms.push_back(choice_of(options));
    return atoms;
  }

  // Operators that ask for the same options share the atom and the units that reach it.
  int choice_of(const std::vector<Condition>& options) {
    std::vector<std::vector<int>> ways;
    for (const Condition& option : options) {
      if (option.impossible) continue;
      ways.push_back(atoms_of(option));
      sort_out(ways.back());
    }
    std::sort(ways.begin(), ways.end());
    ways.erase(std::unique(ways.begin(), ways.end()), ways.end());
    const auto next = static_cast<int>(choice_base_ + choices_.size());
    const auto [choice, added] = choices_.try_emplace(std::move(ways), next);
    if (added) {
      for (const std::vector<int>& needs : choice->first) add_unit(-1, nullptr, needs, {next});
    }
    return choice->second;
  }

  void add_operator(int index) {
    const GroundOperator& op = task_.operators[static_cast<std::size_t>(index)];
    const std::vector<int> precondition = atoms_of(op.precondition);
    for (const GroundEffect& effect : op.effects) {
      if (effect.when.impossible) continue;
      std::vector<int> adds;
      const auto add = [&](int literal) {
        const int atom = result_.atom_of_literal_[static_cast<std::size_t>(literal)];
        if (atom >= 0) adds.push_back(atom);
      };
      for (const int fact : effect.adds) add(2 * fact);
      for (const int fact : effect.deletes) add(2 * fact + 1);
      if (adds.empty() && effect.numeric.empty()) continue;
      std::vector<int> needs = atoms_of(effect.when);
      needs.insert(needs.end(), precondition.begin(), precondition.end());
      add_unit(index, &effect, std::move(needs), std::move(adds));
    }
  }

  void add_axiom(const GroundAxiom& axiom) {
    const int head = result_.atom_of_literal_[static_cast<std::size_t>(2 * axiom.fact)];
    if (head >= 0 && !axiom.body.impossible) add_unit(-1, nullptr, atoms_of(axiom.body), {head});
  }

  void add_unit(int op, const GroundEffect* effect, std::vector<int> needs, std::vector<int> adds) {
    std::vector<Mover> movers;
    const auto unit = static_cast<int>(result_.unit_operator_.size());
    if (effect != nullptr) find_movers(unit, *effect, movers);
    sort_out(needs);
    sort_out(adds);
    result_.unit_operator_.push_back(op);
    result_.unit_effect_.push_back(effect);
    result_.needs_.append(needs);
    result_.adds_.append(adds);
    result_.moved_by_.append(movers);
    if (needs.empty()) result_.without_needs_.push_back(unit);
  }

  // Only what can move a difference towards its relation is a mover.
  void find_movers(int unit, const GroundEffect& effect, std::vector<Mover>& movers) const {
    std::vector<int> touched;
    for (const NumericEffect& numeric : effect.numeric) {
      const std::span<const int> over = comparisons_.over(numeric.variable);
      touched.insert(touched.end(), over.begin(), over.end());
    }
    sort_out(touched);
    for (const int c : touched) {
      result_.add_mover(unit, effect, result_.comparisons_[static_cast<std::size_t>(c)],
                        static_cast<int>(result_.first_comparison_) + c, movers);
    }
  }

  void finish() {
    std::vector<std::vector<int>> needed_by(result_.atoms_), added_by(result_.atoms_);
    std::vector<std::vector<Mover>> movers_of(result_.comparisons_.size());
    std::vector<std::vector<int>> changers(task_.variables.size());
    for (std::size_t u = 0; u < result_.units(); ++u) {
      if (const GroundEffect* effect = result_.unit_effect_[u]) {
        for (const NumericEffect& numeric : effect->numeric) {
          std::vector<int>& list = changers[static_cast<std::size_t>(numeric.variable)];
          if (list.empty() || list.back() != static_cast<int>(u)) list.push_back(static_cast<int>(u));
        }
      }
      for (const int atom : result_.needs(u))
        needed_by[static_cast<std::size_t>(atom)].push_back(static_cast<int>(u));
      for (const int atom : result_.adds(u))
        added_by[static_cast<std::size_t>(atom)].push_back(static_cast<int>(u));
      for (const Mover& mover : result_.moved_by(u)) {
        movers_of[static_cast<std::size_t>(mover.atom) - result_.first_comparison_].push_back(mover);
      }
    }
    result_.needed_by_ = PackedLists<int>(needed_by);
    result_.added_by_ = PackedLists<int>(added_by);
    result_.movers_of_ = PackedLists<Mover>(movers_of);
    result_.changers_ = PackedLists<int>(changers);
  }

  RelaxedTask& result_;
  const StateSpace& space_;
  const GroundTask& task_;
  ComparisonTable comparisons_;
  std::size_t choice_base_ = 0;
  std::map<std::vector<std::vector<int>>, int> choices_;  // atoms by the needs of their options
};

RelaxedTask::RelaxedTask(const StateSpace& space) : space_(space) {
  RelaxedTaskBuilder(*this).build();
}

Interval RelaxedTask::gain_range(const Comparison& comparison, const GroundEffect& effect) const {
  if (!comparison.difference.linear()) return Interval::everything();
  GroundExpression gain;
  for (const NumericEffect& numeric : effect.numeric) {
    for (const LinearTerm& term : comparison.difference.terms) {
      if (term.variable != numeric.variable) continue;
      gain = add_scaled(gain, term.coefficient, change_of(numeric));
    }
  }
  if (gain.is_constant()) return Interval::point(gain.constant);
  const Interval range = evaluate_interval(gain, space_.task().bounds);
  return range.empty() || std::isnan(range.low) || std::isnan(range.high) ? Interval::everything() : range;
}

void RelaxedTask::add_mover(int unit, const GroundEffect& effect, const Comparison& comparison, int atom,
                            std::vector<Mover>& movers) const {
  const Interval gain = gain_range(comparison, effect);
  const bool up = comparison.relation != Relation::Less && comparison.relation != Relation::LessEqual;
  const bool down = comparison.relation != Relation::Greater && comparison.relation != Relation::GreaterEqual;
  if ((up && gain.high > 0.0) || (down && gain.low < 0.0)) movers.push_back({unit, atom, gain});
}

std::vector<Mover> RelaxedTask::movers_towards(const Comparison& comparison, int atom) const {
  std::vector<int> units;
  for_each_variable(comparison.difference, [&](int v) {
    const std::span<const int> list = changers_[static_cast<std::size_t>(v)];
    units.insert(units.end(), list.begin(), list.end());
  });
  sort_out(units);
  std::vector<Mover> movers;
  for (const int u : units)
    add_mover(u, *unit_effect_[static_cast<std::size_t>(u)], comparison, atom, movers);
  return movers;
}

double RelaxedTask::gain(const Mover& mover, const Comparison& compared, const Word* state) const {
  if (mover.constant()) return mover.gain.low;
  if (!compared.difference.linear()) return std::nan("");
  double gain = 0.0;
  for (const NumericEffect& effect : unit_effect_[static_cast<std::size_t>(mover.unit)]->numeric) {
    for (const LinearTerm& term : compared.difference.terms) {
      if (term.variable != effect.variable) continue;
      const double amount = space_.evaluate(effect.amount, state);
      const double before = space_.value(state, effect.variable);
      gain += term.coefficient * (new_value(effect.kind, before, amount) - before);
    }
  }
  return gain;
}

}  // namespace stepwright::pddl
