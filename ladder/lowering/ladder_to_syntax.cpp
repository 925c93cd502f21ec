#include "ladder/lowering/ladder_to_syntax.h"

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
  explicit Writer(const graphic::LadderProgram& ladder) : ladder_(ladder) {}

  std::string text() {
    std::string all;
    for (const Rung& each : ladder_.rungs) {
      line_.clear();
      rung(each);
      all += on_one_line(line_) + "\n";
    }
    return all;
  }

  std::string declarations() const {
    std::string all;
    for (std::size_t i = 0; i < edges_; ++i) all += "VAR __EDGE" + std::to_string(i) + " : BOOL; END_VAR\n";
    for (std::size_t i = 0; i < pulses_; ++i)
      all += "VAR_TEMP __PULSE" + std::to_string(i) + " : BOOL; END_VAR\n";
    if (needs_power_) all += "VAR_TEMP __POWER : BOOL; END_VAR\n";
    return all;
  }

  std::size_t edges() const { return edges_; }

 private:
  void rung(const Rung& rung) {
    if (!rung.label.empty()) line_ += rung.label + ": ";
    const std::string condition = to_st(sensed(rung.condition));
    const bool only_coil =
        rung.coils.size() == 1 && rung.blocks.empty() && rung.jump_to.empty() && !rung.is_return;
    if (only_coil && direct_coil(rung.coils.front(), condition)) return;
    const bool drives =
        !rung.coils.empty() || !rung.blocks.empty() || !rung.jump_to.empty() || rung.is_return;
    if (!drives) return;
    needs_power_ = true;
    line_ += "__POWER := " + condition + "; ";
    for (const Block& each : rung.blocks) block(each);
    for (const Coil& each : rung.coils) coil(each);
    if (!rung.jump_to.empty()) line_ += "IF __POWER THEN JMP " + rung.jump_to + "; END_IF; ";
    if (rung.is_return) line_ += "IF __POWER THEN RETURN; END_IF; ";
  }

  // The condition with each edge replaced by a variable that was computed before it.
  Condition sensed(const Condition& condition) {
    Condition result = condition;
    if (condition.kind == ConditionKind::Contact && condition.edge != Edge::None) {
      const std::string pulse = "__PULSE" + std::to_string(pulses_++);
      const std::string state = "__EDGE" + std::to_string(edges_++);
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
    if (direct_coil(coil, "__POWER")) return;
    const std::string state = "__EDGE" + std::to_string(edges_++);
    const bool rising = coil.kind == CoilKind::RisingEdge;
    line_ += coil.variable + " := " + (rising ? "__POWER AND NOT " + state : state + " AND NOT __POWER") +
             "; " + state + " := __POWER; ";
  }

  void block(const Block& block) {
    std::string body;
    std::string ends = "";
    if (block.type.empty()) {
      body = block.st_body + "; ";
    } else if (!block.instance.empty()) {
      body = block.instance + "(" + arguments(block, "") + "); ";
    } else {
      const std::string result = result_of(block);
      if (!result.empty()) body = result + " := ";
      body += block.type + "(" + arguments(block, result) + "); ";
    }
    for (const auto& [formal, variable] : block.outputs)
      if (source::upper(formal) == "ENO" && !variable.empty()) ends += variable + " := __POWER; ";
    const bool always = !block.instance.empty() && !block.power_input.empty();
    line_ += (always ? body : "IF __POWER THEN " + body + "END_IF; ") + ends;
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

  static std::string arguments(const Block& block, const std::string& result) {
    std::string list;
    const auto add = [&](const std::string& argument) { list += (list.empty() ? "" : ", ") + argument; };
    if (!block.power_input.empty()) add(block.power_input + " := __POWER");
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
  std::string line_;
  std::size_t edges_ = 0;
  std::size_t pulses_ = 0;
  bool needs_power_ = false;
};

}  // namespace

LadderStatements ladder_to_syntax(const graphic::LadderProgram& ladder, const std::string& file_name,
                                  bool keeps_state, syntax::SyntaxContext& context) {
  Writer writer(ladder);
  const source::FileId file = context.sources.add(file_name, writer.text());
  LadderStatements result;
  if (writer.edges() > 0 && !keeps_state) {
    context.sink.error(source::code::kEdgeInFunction, {file, 0},
                       "a function keeps no state, so its rungs cannot sense edges", "use a function block");
    return result;
  }
  result.body = syntax::parse_statements(context, file, syntax::TextKind::Generated);
  const std::string declarations = writer.declarations();
  if (!declarations.empty()) {
    const source::FileId variables = context.sources.add(file_name, declarations);
    result.variables = syntax::parse_variables(context, variables, syntax::TextKind::Generated);
  }
  return result;
}

}  // namespace stepwright::lowering
