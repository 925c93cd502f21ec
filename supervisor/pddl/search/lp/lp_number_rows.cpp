#include "supervisor/pddl/search/lp/lp_number_rows.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "supervisor/pddl/ground_task/relaxed_bounds.h"
#include "supervisor/pddl/search/space/integer_ranges.h"

namespace stepwright::pddl {
namespace {

// More expressions than this are not looked at: each is a row.
constexpr std::size_t kMostExpressions = 2000;
// Nor are more operators, over all rows: tasks that large are not solved by linear programs.
constexpr std::size_t kMostWork = 1'000'000;
// `stop` is asked after so many of them.
constexpr std::size_t kPause = 64;

bool defined(Interval interval) {
  return !interval.empty() && !std::isnan(interval.low) && !std::isnan(interval.high);
}

GroundExpression scaled(const GroundExpression& expression, double factor) {
  GroundExpression zero;
  GroundExpression result = add_scaled(zero, factor, expression);
  result.constant = 0.0;
  return result;
}

class Builder {
 public:
  Builder(const StateSpace& space, const std::function<bool()>& stop)
      : space_(space),
        task_(space.task()),
        stop_(stop),
        initial_(space.initial()),
        integers_(integer_variables(task_)) {
    touching_.resize(task_.variables.size());
    for (std::size_t i = 0; i < task_.operators.size(); ++i) {
      for (const GroundEffect& effect : task_.operators[i].effects) {
        for (const NumericEffect& numeric : effect.numeric) {
          auto& list = touching_[static_cast<std::size_t>(numeric.variable)];
          if (list.empty() || list.back() != static_cast<int>(i)) list.push_back(static_cast<int>(i));
        }
      }
    }
  }

  std::vector<NumberRow> rows() {
    for (const Comparison& comparison : task_.goal.comparisons) {
      if (enough()) return std::move(rows_);
      add_goal(comparison);
    }
    for (std::size_t v = 0; v < task_.variables.size(); ++v) {
      note(variable_expression(static_cast<int>(v)));
    }
    for (const GroundOperator& op : task_.operators) {
      for (const Comparison& comparison : op.precondition.comparisons) note(comparison.difference);
    }
    for (const auto& [terms, expression] : noted_) {
      if (enough()) break;
      add_least(expression);
      add_least(scaled(expression, -1.0));
    }
    return std::move(rows_);
  }

 private:
  bool enough() const { return work_ > kMostWork || stop_(); }

  using Key = std::vector<std::pair<int, double>>;

  static Key key_of(const GroundExpression& expression) {
    Key key;
    for (const LinearTerm& term : expression.terms) key.emplace_back(term.variable, term.coefficient);
    return key;
  }

  void note(const GroundExpression& difference) {
    if (!difference.linear() || difference.terms.empty() || noted_.size() >= kMostExpressions) return;
    // Differences that only point the other way are the same expression.
    const double sign = difference.terms.front().coefficient < 0.0 ? -1.0 : 1.0;
    GroundExpression expression = scaled(difference, sign);
    Key key = key_of(expression);
    noted_.emplace(std::move(key), std::move(expression));
  }

  void add_goal(const Comparison& comparison) {
    const GroundExpression& difference = comparison.difference;
    if (!difference.linear() || difference.terms.empty()) return;
    note(difference);
    const bool integer = is_integer(difference, integers_);
    const bool strict = comparison.relation == Relation::Greater || comparison.relation == Relation::Less;
    const double beyond = strict && integer ? 1.0 : 0.0;
    const Relation relation = comparison.relation;
    if (relation != Relation::Less && relation != Relation::LessEqual) {
      require(scaled(difference, 1.0), beyond - difference.constant, true);
    }
    if (relation != Relation::Greater && relation != Relation::GreaterEqual) {
      require(scaled(difference, -1.0), beyond + difference.constant, true);
    }
  }

  // The least value of the expression: it starts with one, and each operator leaves at least one.
  void add_least(const GroundExpression& expression) {
    double least = space_.evaluate(expression, initial_.data());
    if (std::isnan(least)) return;
    for (const int i : operators_on(expression)) {
      if (++work_ % kPause == 0 && stop_()) return;
      const GroundOperator& op = task_.operators[static_cast<std::size_t>(i)];
      if (!(least_change(expression, op) < 0.0)) continue;
      least = std::min(least, least_after(expression, op));
    }
    const Interval range = evaluate_interval(expression, task_.bounds);
    if (defined(range)) least = std::max(least, range.low);
    if (std::isfinite(least)) require(expression, least, false);
  }

  std::vector<int> operators_on(const GroundExpression& expression) const {
    std::vector<int> list;
    for (const LinearTerm& term : expression.terms) {
      const auto& touching = touching_[static_cast<std::size_t>(term.variable)];
      list.insert(list.end(), touching.begin(), touching.end());
    }
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    return list;
  }

  // What the effect adds to the expression, as an expression of the state before.
  static GroundExpression change_of(const GroundExpression& expression, const GroundEffect& effect) {
    GroundExpression change;
    for (const NumericEffect& numeric : effect.numeric) {
      for (const LinearTerm& term : expression.terms) {
        if (term.variable != numeric.variable) continue;
        const GroundExpression before = variable_expression(numeric.variable);
        change =
            add_scaled(change, term.coefficient, combine(NumericKind::Subtract, result_of(numeric), before));
      }
    }
    return change;
  }

  Interval range_of(const GroundExpression& expression, const std::vector<const Condition*>& when) const {
    const Interval range = implied_interval(expression, when, task_.bounds);
    return defined(range) ? range : Interval::everything();
  }

  // What an operator adds to an expression: its effects that always happen together, and the others.
  struct Addition {
    GroundExpression always;
    double others = 0.0;
  };

  // `pick` says of the range of an effect that may happen what it is counted as.
  template <typename Pick>
  Addition addition(const GroundExpression& expression, const GroundOperator& op, const Pick& pick) const {
    Addition sum;
    for (const GroundEffect& effect : op.effects) {
      if (effect.when.impossible) continue;
      const GroundExpression change = change_of(expression, effect);
      if (effect.when.always()) {
        sum.always = add_scaled(sum.always, 1.0, change);
      } else {
        sum.others += pick(range_of(change, {&op.precondition, &effect.when}));
      }
    }
    return sum;
  }

  // Each of the effects that may happen if it helps.
  double most_change(const GroundExpression& expression, const GroundOperator& op) const {
    const Addition sum = addition(expression, op, [](Interval range) { return std::max(0.0, range.high); });
    return range_of(sum.always, {&op.precondition}).high + sum.others;
  }

  double least_change(const GroundExpression& expression, const GroundOperator& op) const {
    return -most_change(scaled(expression, -1.0), op);
  }

  // The least value that the operator leaves when it is applied.
  double least_after(const GroundExpression& expression, const GroundOperator& op) const {
    const Addition sum = addition(expression, op, [](Interval range) { return std::min(0.0, range.low); });
    return range_of(add_scaled(expression, 1.0, sum.always), {&op.precondition}).low + sum.others;
  }

  void require(GroundExpression expression, double least, bool always) {
    Key key = key_of(expression);
    if (const auto known = places_.find(key); known != places_.end()) {
      NumberRow& row = rows_[known->second];
      row.least = std::max(row.least, least);
      return;
    }
    LpRow row;
    bool falls = always;
    for (const int i : operators_on(expression)) {
      if (++work_ % kPause == 0 && stop_()) return;
      const double change = most_change(expression, task_.operators[static_cast<std::size_t>(i)]);
      if (change == kInfinity || !(std::abs(change) < 1e7)) return;  // the row would say nothing
      if (std::abs(change) < 1e-9) continue;
      falls = falls || change < 0.0;
      row.entries.push_back({i, change});
    }
    if (!falls) return;
    places_.emplace(std::move(key), rows_.size());
    const bool integer = is_integer(expression, integers_);
    rows_.push_back({std::move(expression), least, integer, std::move(row)});
  }

  const StateSpace& space_;
  const GroundTask& task_;
  const std::function<bool()>& stop_;
  std::size_t work_ = 0;  // operators looked at
  std::vector<Word> initial_;
  std::vector<bool> integers_;
  std::vector<std::vector<int>> touching_;  // by variable: operators, ascending
  std::map<Key, GroundExpression> noted_;
  std::map<Key, std::size_t> places_;
  std::vector<NumberRow> rows_;
};

}  // namespace

std::vector<NumberRow> number_rows(const StateSpace& space, const std::function<bool()>& stop) {
  return Builder(space, stop).rows();
}

}  // namespace stepwright::pddl
