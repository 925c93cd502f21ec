#include "tests/support/ladder_evaluator.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace stepwright::support {

using graphic::CompareOp;
using graphic::Condition;
using graphic::ConditionKind;

std::int64_t literal(const std::string& text) {
  if (text == "TRUE") return 1;
  if (text == "FALSE") return 0;
  if (text.rfind("T#", 0) != 0) {
    std::size_t used = 0;
    const std::int64_t number = std::stoll(text, &used);
    if (used != text.size()) throw std::runtime_error("no literal: " + text);
    return number;
  }
  std::istringstream stream(text.substr(2));
  std::int64_t number = 0;
  std::string unit;
  stream >> number >> unit;
  if (unit == "ms") return number * 1'000'000;
  if (unit == "s") return number * 1'000'000'000;
  if (unit == "d") return number * 86'400 * 1'000'000'000;
  throw std::runtime_error("no time literal: " + text);
}

LadderEvaluator::LadderEvaluator(const graphic::Pou& ladder)
    : program_(std::get<graphic::LadderProgram>(ladder.body)) {
  for (const graphic::Variable& variable : ladder.variables) {
    if (variable.type == "TON") {
      values_[variable.name + ".Q"] = 0;
      timers_[variable.name];
    } else {
      values_[variable.name] = variable.initial.empty() ? 0 : literal(variable.initial);
    }
  }
}

void LadderEvaluator::scan(std::int64_t now_ns) {
  now_ns_ = now_ns;
  for (const graphic::Rung& rung : program_.rungs) {
    const bool power = test(rung.condition);
    for (const graphic::Block& block : rung.blocks) run(block, power);
    for (const graphic::Coil& coil : rung.coils) drive(coil, power);
  }
}

std::int64_t LadderEvaluator::get(const std::string& name) const {
  const auto found = values_.find(name);
  if (found == values_.end()) throw std::runtime_error("no variable: " + name);
  return found->second;
}

std::int64_t LadderEvaluator::value(const std::string& operand) const {
  const auto found = values_.find(operand);
  return found != values_.end() ? found->second : literal(operand);
}

bool LadderEvaluator::test(const Condition& condition) const {
  const auto child = [this](const Condition& c) { return test(c); };
  switch (condition.kind) {
    case ConditionKind::True:
      return true;
    case ConditionKind::Contact:
      return (get(condition.name) != 0) != condition.negated;
    case ConditionKind::All:
      return std::all_of(condition.children.begin(), condition.children.end(), child);
    case ConditionKind::Any:
      return std::any_of(condition.children.begin(), condition.children.end(), child);
    case ConditionKind::Comparison: {
      const std::int64_t a = value(condition.name);
      const std::int64_t b = value(condition.operand);
      switch (condition.op) {
        case CompareOp::Equal:
          return a == b;
        case CompareOp::NotEqual:
          return a != b;
        case CompareOp::Less:
          return a < b;
        case CompareOp::LessEqual:
          return a <= b;
        case CompareOp::Greater:
          return a > b;
        case CompareOp::GreaterEqual:
          return a >= b;
      }
      break;
    }
    case ConditionKind::Expression:
      break;
  }
  throw std::runtime_error("condition not evaluated: " + graphic::to_st(condition));
}

void LadderEvaluator::run(const graphic::Block& block, bool power) {
  if (block.type.empty()) {
    if (power) run_statements(block.st_body);
    return;
  }
  if (block.type != "TON" || block.power_input != "IN") throw std::runtime_error("block not evaluated");
  Timer& timer = timers_.at(block.instance);
  if (power && !timer.running) timer.since_ns = now_ns_;
  timer.running = power;
  const std::int64_t preset = value(block.inputs.at(0).second);
  const std::int64_t elapsed = power ? std::min(now_ns_ - timer.since_ns, preset) : 0;
  values_[block.instance + ".Q"] = power && elapsed >= preset;
  for (const auto& [formal, variable] : block.outputs) {
    values_[variable] = formal == "ET" ? elapsed : values_[block.instance + ".Q"];
  }
}

void LadderEvaluator::run_statements(const std::string& text) {
  std::istringstream statements(text);
  for (std::string statement; std::getline(statements, statement, ';');) {
    std::istringstream words(statement);
    std::string target;
    std::string assign;
    std::string left;
    if (!(words >> target)) continue;
    if (!(words >> assign >> left) || assign != ":=") throw std::runtime_error("statement: " + statement);
    std::int64_t result = value(left);
    std::string op;
    std::string right;
    if (words >> op >> right) result += op == "-" ? -value(right) : value(right);
    values_[target] = result;
  }
}

void LadderEvaluator::drive(const graphic::Coil& coil, bool power) {
  switch (coil.kind) {
    case graphic::CoilKind::Normal:
      values_[coil.variable] = power;
      return;
    case graphic::CoilKind::Negated:
      values_[coil.variable] = !power;
      return;
    case graphic::CoilKind::Set:
      if (power) values_[coil.variable] = 1;
      return;
    case graphic::CoilKind::Reset:
      if (power) values_[coil.variable] = 0;
      return;
    default:
      throw std::runtime_error("coil not evaluated");
  }
}

}  // namespace stepwright::support
