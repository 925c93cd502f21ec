#include "tests/fuzz/st/condition_chart.h"

#include <algorithm>
#include <numeric>

namespace stepwright::st_fuzz {
namespace {

using Kind = ChartCondition::Kind;

std::string name(const char* prefix, std::size_t index) {
  return prefix + std::to_string(index);
}

std::string list(const std::vector<std::size_t>& steps) {
  std::string text;
  for (const std::size_t each : steps) text += (text.empty() ? "" : ", ") + name("S", each);
  return steps.size() == 1 ? text : "(" + text + ")";
}

ChartCondition condition(Random& random, std::size_t steps, int depth) {
  ChartCondition result;
  result.literal = random.between(-3, 3);
  switch (random.below(depth > 0 ? 12 : 8)) {
    case 0:
      return result;
    case 1:
      result.kind = Kind::Step;
      result.index = random.below(steps);
      return result;
    case 2:
      result.kind = Kind::Greater;
      result.index = random.below(kChartNumbers);
      return result;
    case 3:
    case 4:
      result.kind = Kind::Quotient;
      result.index = random.below(kChartNumbers);
      return result;
    case 5:
    case 6:
      result.kind = random.chance(70) ? Kind::Count : Kind::Counted;
      result.index = random.below(kChartCounters);
      result.children.push_back(condition(random, steps, 0));
      return result;
    case 8:
      result.kind = Kind::Not;
      result.children.push_back(condition(random, steps, depth - 1));
      return result;
    case 9:
    case 10:
    case 11:
      result.kind = random.chance(50) ? Kind::And : Kind::Or;
      for (int i = 0; i < 2; ++i) result.children.push_back(condition(random, steps, depth - 1));
      return result;
    default:
      result.kind = Kind::Input;
      result.index = random.below(kChartInputs);
      return result;
  }
}

std::vector<std::size_t> some_steps(Random& random, std::size_t steps) {
  std::vector<std::size_t> result{random.below(steps)};
  if (random.chance(30)) {
    const std::size_t other = random.below(steps);
    if (other != result.front()) result.push_back(other);
  }
  return result;
}

}  // namespace

std::string ChartCondition::text() const {
  switch (kind) {
    case Kind::True:
      return "TRUE";
    case Kind::Input:
      return name("in", index);
    case Kind::Step:
      return name("S", index) + ".X";
    case Kind::Greater:
      return "(" + name("d", index) + " > " + std::to_string(literal) + ")";
    case Kind::Quotient:
      return "(10 / " + name("d", index) + " > " + std::to_string(literal) + ")";
    case Kind::Count:
      return "Count(n := " + name("c", index) + ", v := " + children[0].text() + ")";
    case Kind::Counted:
      return "(" + name("c", index) + " > " + std::to_string(literal) + ")";
    case Kind::Not:
      return "NOT (" + children[0].text() + ")";
    case Kind::And:
    case Kind::Or:
      return "(" + children[0].text() + (kind == Kind::And ? " AND " : " OR ") + children[1].text() + ")";
  }
  return {};
}

std::optional<bool> ChartCondition::evaluate(ChartValues& values) const {
  std::vector<bool> operands;
  if (kind != Kind::Counted) {
    for (const ChartCondition& each : children) {
      const std::optional<bool> operand = each.evaluate(values);
      if (!operand) return std::nullopt;
      operands.push_back(*operand);
    }
  }
  switch (kind) {
    case Kind::True:
      return true;
    case Kind::Input:
      return values.inputs[index];
    case Kind::Step:
      return values.steps[index];
    case Kind::Greater:
      return values.numbers[index] > literal;
    case Kind::Quotient:
      if (values.numbers[index] == 0) return std::nullopt;
      return 10 / values.numbers[index] > literal;
    case Kind::Count:
      ++values.counters[index];
      return operands[0];
    case Kind::Counted:
      return values.counters[index] > literal;
    case Kind::Not:
      return !operands[0];
    case Kind::And:
      return operands[0] && operands[1];
    case Kind::Or:
      return operands[0] || operands[1];
  }
  return std::nullopt;
}

std::string ConditionChart::text() const {
  std::string text =
      "VAR_GLOBAL c3 : DINT; END_VAR\n"
      "FUNCTION Count : BOOL\nVAR_IN_OUT n : DINT; END_VAR VAR_INPUT v : BOOL; END_VAR\n"
      "n := n + 1; Count := v;\nEND_FUNCTION\n"
      "PROGRAM main\nVAR_EXTERNAL c3 : DINT; END_VAR\n"
      "VAR in0, in1, in2 : BOOL; d0, d1, d2, c0, c1, c2 : DINT; END_VAR\n";
  for (std::size_t i = 0; i < steps.size(); ++i)
    text += std::string(i == 0 ? "INITIAL_STEP " : "STEP ") + name("S", i) + ": " + name("a", i) +
            "(N); END_STEP\n";
  for (const ChartTransition& each : transitions) {
    const std::string priority =
        each.priority == 0 ? "" : "(PRIORITY := " + std::to_string(each.priority) + ") ";
    text += "TRANSITION " + priority + "FROM " + list(each.sources) + " TO " + list(each.targets) +
            " := " + each.condition.text() + "; END_TRANSITION\n";
  }
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::string number = name("d", steps[i].number);
    text += "ACTION " + name("a", i) + ": " + number + " := " + (steps[i].keeps ? number + " + " : "") +
            std::to_string(steps[i].value) + "; END_ACTION\n";
  }
  return text + "END_PROGRAM\n";
}

ConditionChart random_condition_chart(Random& random) {
  ConditionChart chart;
  chart.steps.resize(2 + random.below(5));
  for (ConditionChart::Step& each : chart.steps)
    each = {random.below(kChartNumbers), random.chance(30), random.between(-2, 5)};
  for (std::size_t i = 2 + random.below(8); i > 0; --i) {
    ChartTransition each;
    each.sources = some_steps(random, chart.steps.size());
    each.targets = some_steps(random, chart.steps.size());
    each.priority = random.chance(60) ? 0 : static_cast<int>(random.below(3));
    each.condition = condition(random, chart.steps.size(), 2);
    chart.transitions.push_back(std::move(each));
  }
  return chart;
}

bool ConditionChartRun::scan(const std::array<bool, kChartInputs>& inputs) {
  values_.inputs = inputs;
  std::vector<bool> now = values_.steps;
  if (first_) now[0] = true;
  std::vector<std::size_t> order(chart_.transitions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t each) { return chart_.transitions[each].priority; });
  std::vector<bool> entered(now.size(), false);
  std::vector<bool> left(now.size(), false);
  for (const std::size_t index : order) {
    const ChartTransition& each = chart_.transitions[index];
    const bool enabled = std::ranges::all_of(
        each.sources, [&](std::size_t step) { return values_.steps[step] && !left[step]; });
    if (!enabled) continue;
    const std::optional<bool> fires = each.condition.evaluate(values_);
    if (!fires) return false;
    if (!*fires) continue;
    for (const std::size_t step : each.sources) left[step] = true;
    for (const std::size_t step : each.targets) entered[step] = true;
  }
  for (std::size_t step = 0; step < now.size(); ++step)
    now[step] = entered[step] || (now[step] && !left[step]);
  first_ = false;
  values_.steps = std::move(now);
  for (std::size_t step = 0; step < chart_.steps.size(); ++step) {
    if (!values_.steps[step]) continue;
    const ConditionChart::Step& body = chart_.steps[step];
    std::int64_t& number = values_.numbers[body.number];
    number = (body.keeps ? number : 0) + body.value;
  }
  return true;
}

}  // namespace stepwright::st_fuzz
