#include "ladder/lowering/shown_conditions.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "ladder/graphic/identifier.h"
#include "ladder/lowering/text_names.h"

namespace stepwright::lowering {

namespace {

using graphic::Block;
using graphic::CoilKind;
using graphic::Condition;
using graphic::ConditionKind;
using graphic::Edge;
using graphic::Rung;

// Wires that several others read make texts that double from one to the next.
constexpr std::size_t kLongest = 1000;

// "a", "timer.Q", "list[3]": what needs no parentheses wherever it stands.
bool is_path(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '[' || c == ']';
  });
}

// Beside an operator.
std::string operand(const Condition& value) {
  const bool is_group = value.negated || value.kind == ConditionKind::All || value.kind == ConditionKind::Any;
  return is_group ? "(" + to_st(value) + ")" : to_st(value);
}

// Alone, as in an argument.
std::string whole(const Condition& value) {
  return value.kind == ConditionKind::Expression && !value.negated ? value.name : to_st(value);
}

// IN, IN1, IN2 ...: names that say no more than the place.
bool is_by_place(const Block& block) {
  for (std::size_t i = 0; i < block.inputs.size(); ++i) {
    const std::string& formal = block.inputs[i].first;
    const bool only = i == 0 && block.inputs.size() == 1 && graphic::same_name(formal, "IN");
    if (!only && !formal.empty() && !graphic::same_name(formal, "IN" + std::to_string(i + 1))) return false;
  }
  return true;
}

}  // namespace

ShownConditions::ShownConditions(const graphic::LadderProgram& networks) {
  for (const graphic::Wire& each : networks.wires) {
    wires_.insert(each.name);
    if (each.keeps) keeping_.insert(each.name);
  }
  for (const Rung& each : networks.rungs) define(each);
}

void ShownConditions::define(const Rung& rung) {
  if (rung.blocks.empty() && rung.coils.size() == 1 && rung.coils.front().kind == CoilKind::Normal)
    return define(rung.coils.front().variable, drawn(rung.condition));
  if (rung.condition.kind != ConditionKind::True || rung.blocks.size() != 1 || !rung.coils.empty()) return;
  const Block& block = rung.blocks.front();
  if (block.type.empty()) {
    const auto assign = block.st_body.find(" := ");
    if (assign == std::string::npos) return;
    const std::string value = text(block.st_body.substr(assign + 4));
    Condition condition = graphic::contact(value);
    if (!is_path(value)) condition.kind = ConditionKind::Expression;
    return define(block.st_body.substr(0, assign), std::move(condition));
  }
  if (!block.instance.empty()) return;
  for (const auto& [formal, variable] : block.outputs) {
    const bool is_result =
        formal.empty() || graphic::same_name(formal, "OUT") || graphic::same_name(formal, block.type);
    if (is_result) define(variable, graphic::contact(call(block)));
  }
}

void ShownConditions::define(const std::string& wire, Condition value) {
  if (!wires_.contains(wire) || keeping_.contains(wire) || to_st(value).size() > kLongest) return;
  values_.insert_or_assign(wire, std::move(value));
}

const Condition* ShownConditions::value_of(const std::string& word) const {
  const auto found = values_.find(word);
  return found == values_.end() ? nullptr : &found->second;
}

std::string ShownConditions::text(const std::string& st) {
  return each_name(st, [&](const std::string& word) {
    if (const Condition* value = value_of(word)) return operand(*value);
    if (!wires_.contains(word)) return word;
    return connector_name(connectors_.try_emplace(word, connectors_.size() + 1).first->second);
  });
}

std::string ShownConditions::call(const Block& block) {
  const bool by_place = is_by_place(block);
  std::string list;
  for (const auto& [formal, argument] : block.inputs) {
    if (argument.empty()) continue;
    const Condition* value = value_of(argument);
    list += (list.empty() ? "" : ", ") + (formal.empty() || by_place ? "" : formal + " := ") +
            (value != nullptr ? whole(*value) : text(argument));
  }
  return block.type + "(" + list + ")";
}

Condition ShownConditions::drawn(Condition condition) {
  for (Condition& each : condition.children) each = drawn(std::move(each));
  switch (condition.kind) {
    case ConditionKind::True:
      return condition;
    case ConditionKind::All:
      return graphic::all(std::move(condition.children));
    case ConditionKind::Any:
      return graphic::any(std::move(condition.children));
    case ConditionKind::Contact:
    case ConditionKind::Expression:
      if (const Condition* value = value_of(condition.name)) {
        if (condition.edge == Edge::None) return condition.negated ? graphic::negation(*value) : *value;
        condition.name = whole(*value);
        return condition;
      }
      break;
    case ConditionKind::Comparison:
      condition.operand = text(condition.operand);
      break;
  }
  condition.name = text(condition.name);
  return condition;
}

}  // namespace stepwright::lowering
