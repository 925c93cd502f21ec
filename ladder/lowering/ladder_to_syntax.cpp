#include "ladder/lowering/ladder_to_syntax.h"

#include <algorithm>
#include <utility>

#include "ladder/source/codes.h"
#include "ladder/source/name_table.h"

namespace stepwright::lowering {

namespace {

using graphic::Block;
using graphic::Coil;
using graphic::CoilKind;
using graphic::Condition;
using graphic::ConditionKind;
using graphic::Edge;
using graphic::Rung;

// Statements of several lines on one line: comments up to the end of a line would swallow the rest. Every
// character keeps its distance from the last mark of a written source.
std::string on_one_line(const std::string& text) {
  std::string line = text;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool comment = line[i] == '/' && i + 1 < line.size() && line[i + 1] == '/';
    if (comment) {
      while (i < line.size() && line[i] != '\n') line[i++] = ' ';
      if (i == line.size()) break;
    } else if (line[i] == '(' && i + 1 < line.size() && line[i + 1] == '*') {
      const std::size_t end = line.find("*)", i + 2);
      for (const std::size_t last = end == std::string::npos ? line.size() : end; i < last; ++i)
        if (line[i] == '\n' || line[i] == '\r') line[i] = ' ';
      --i;
    }
    if (line[i] == '\n' || line[i] == '\r') line[i] = ' ';
  }
  return line;
}

class Writer {
 public:
  Writer(const graphic::LadderProgram& ladder, std::string prefix)
      : ladder_(ladder), prefix_(std::move(prefix)), variables_(ladder.wires) {}

  std::string text() {
    std::string all;
    for (const Rung& each : ladder_.rungs) {
      line_.clear();
      rung(each);
      all += on_one_line(line_) + "\n";
    }
    return all;
  }

  std::vector<graphic::Wire> variables() {
    if (needs_power_) variables_.push_back({power(), "BOOL", false});
    return std::move(variables_);
  }

  std::size_t edges() const { return edges_; }

 private:
  std::string power() const { return prefix_ + "POWER"; }

  // The state of an edge: FALSE at the start.
  std::string new_edge() {
    const std::string& name =
        variables_.emplace_back(graphic::Wire{prefix_ + "EDGE" + std::to_string(edges_++), "BOOL", true})
            .name;
    return name;
  }

  void rung(const Rung& rung) {
    line_ += rung.place;
    if (!rung.label.empty()) line_ += rung.label + ": ";
    const std::string condition = to_st(sensed(rung.condition));
    const bool only_coil =
        rung.coils.size() == 1 && rung.blocks.empty() && rung.jump_to.empty() && !rung.is_return;
    if (only_coil && direct_coil(rung.coils.front(), condition)) return;
    const bool drives =
        !rung.coils.empty() || !rung.blocks.empty() || !rung.jump_to.empty() || rung.is_return;
    if (!drives) return;
    if (rung.condition.kind == ConditionKind::True && always(rung)) return;
    needs_power_ = true;
    line_ += power() + " := " + condition + "; ";
    for (const Block& each : rung.blocks) block(each);
    for (const Coil& each : rung.coils) coil(each);
    if (!rung.jump_to.empty()) line_ += "IF " + power() + " THEN JMP " + rung.jump_to + "; END_IF; ";
    if (rung.is_return) line_ += "IF " + power() + " THEN RETURN; END_IF; ";
  }

  // A block or jump right at the rail needs no test.
  bool always(const Rung& rung) {
    if (!rung.coils.empty() || rung.blocks.size() > 1) return false;
    if (rung.blocks.size() == 1) {
      const Block& only = rung.blocks.front();
      const bool enable_out = std::any_of(only.outputs.begin(), only.outputs.end(),
                                          [](const auto& pin) { return source::upper(pin.first) == "ENO"; });
      if (!only.power_input.empty() || enable_out || !rung.jump_to.empty() || rung.is_return) return false;
      line_ += call_text(only);
      return true;
    }
    line_ += rung.is_return ? "RETURN; " : "JMP " + rung.jump_to + "; ";
    return true;
  }

  // The condition with each edge replaced by a variable that was computed before it.
  Condition sensed(const Condition& condition) {
    Condition result = condition;
    if (condition.kind == ConditionKind::Contact && condition.edge != Edge::None) {
      const std::string pulse = prefix_ + "PULSE" + std::to_string(pulses_++);
      variables_.push_back({pulse, "BOOL", false});
      const std::string state = new_edge();
      const bool rising = condition.edge == Edge::Rising;
      line_ += pulse + " := " +
               (rising ? condition.name + " AND NOT " + state : state + " AND NOT " + condition.name) + "; " +
               state + " := " + condition.name + "; ";
      return graphic::contact(pulse, condition.negated);
    }
    for (Condition& child : result.children) child = sensed(child);
    return result;
  }

  bool direct_coil(const Coil& coil, const std::string& condition) {
    switch (coil.kind) {
      case CoilKind::Normal:
        line_ += coil.variable + " := " + condition + "; ";
        return true;
      case CoilKind::Negated:
        line_ += coil.variable + " := NOT (" + condition + "); ";
        return true;
      case CoilKind::Set:
        line_ += coil.variable + " := " + coil.variable + " OR (" + condition + "); ";
        return true;
      case CoilKind::Reset:
        line_ += coil.variable + " := " + coil.variable + " AND NOT (" + condition + "); ";
        return true;
      default:
        return false;
    }
  }

  void coil(const Coil& coil) {
    if (direct_coil(coil, power())) return;
    const std::string state = new_edge();
    const bool rising = coil.kind == CoilKind::RisingEdge;
    line_ += coil.variable +
             " := " + (rising ? power() + " AND NOT " + state : state + " AND NOT " + power()) + "; " +
             state + " := " + power() + "; ";
  }

  void block(const Block& block) {
    std::string ends;
    for (const auto& [formal, variable] : block.outputs)
      if (source::upper(formal) == "ENO" && !variable.empty()) ends += variable + " := " + power() + "; ";
    const bool runs = !block.instance.empty() && !block.power_input.empty();
    const std::string body = call_text(block);
    line_ += (runs ? body : "IF " + power() + " THEN " + body + "END_IF; ") + ends;
  }

  std::string call_text(const Block& block) const {
    if (block.type.empty()) return block.st_body + "; ";
    if (!block.instance.empty()) return block.instance + "(" + arguments(block, "") + "); ";
    const std::string result = result_of(block);
    return (result.empty() ? "" : result + " := ") + block.type + "(" + arguments(block, result) + "); ";
  }

  // The variable that takes the result of a function.
  static std::string result_of(const Block& block) {
    for (const auto& [formal, variable] : block.outputs)
      if (is_result(block, formal)) return variable;
    return {};
  }

  static bool is_result(const Block& block, const std::string& formal) {
    const std::string folded = source::upper(formal);
    return folded.empty() || folded == "OUT" || folded == source::upper(block.type);
  }

  std::string arguments(const Block& block, const std::string& result) const {
    std::string list;
    const auto add = [&](const std::string& argument) { list += (list.empty() ? "" : ", ") + argument; };
    if (!block.power_input.empty()) add(block.power_input + " := " + power());
    for (const auto& [formal, expression] : block.inputs) {
      if (source::upper(formal) == "EN" || expression.empty()) continue;
      add(formal.empty() ? expression : formal + " := " + expression);
    }
    for (const auto& [formal, variable] : block.outputs) {
      const bool taken = !result.empty() && is_result(block, formal);
      if (!taken && source::upper(formal) != "ENO" && !variable.empty()) add(formal + " => " + variable);
    }
    return list;
  }

  const graphic::LadderProgram& ladder_;
  std::string prefix_;
  std::vector<graphic::Wire> variables_;
  std::string line_;
  std::size_t edges_ = 0;
  std::size_t pulses_ = 0;
  bool needs_power_ = false;
};

}  // namespace

LadderText ladder_text(const graphic::LadderProgram& ladder, const std::string& prefix) {
  Writer writer(ladder, prefix);
  LadderText result;
  result.statements = writer.text();
  result.variables = writer.variables();
  return result;
}

LadderStatements ladder_to_syntax(const graphic::LadderProgram& ladder, const std::string& file_name,
                                  bool keeps_state, syntax::SyntaxContext& context) {
  Writer writer(ladder, "__");
  const source::FileId file = context.sources.add(file_name, writer.text());
  LadderStatements result;
  if (writer.edges() > 0 && !keeps_state) {
    context.sink.error(source::code::kEdgeInFunction, {file, 0},
                       "a function keeps no state, so its rungs cannot sense edges", "use a function block");
    return result;
  }
  result.body = syntax::parse_statements(context, file, syntax::TextKind::Generated);
  std::string declarations;
  const std::vector<graphic::Wire> wires = writer.variables();
  for (const graphic::Wire& each : wires) declarations += declaration_of(each, keeps_state);
  if (declarations.empty()) return result;
  const source::FileId variables = context.sources.add(file_name, declarations);
  result.variables = syntax::parse_variables(context, variables, syntax::TextKind::Generated);
  for (std::size_t i = 0; i < wires.size() && i < result.variables.size(); ++i)
    if (wires[i].type.empty()) result.variables[i].type->kind = syntax::TypeKind::Deduced;
  return result;
}

std::string declaration_of(const graphic::Wire& wire, bool keeps_state) {
  const bool keeps = wire.keeps && keeps_state;
  return std::string(keeps ? "VAR " : "VAR_TEMP ") + wire.name + " : " +
         (wire.type.empty() ? "BOOL" : wire.type) + "; END_VAR\n";
}

}  // namespace stepwright::lowering
