#include "ladder/lowering/ladder_to_syntax.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "ladder/source/codes.h"
#include "ladder/source/name_table.h"
#include "ladder/syntax/piece.h"

namespace stepwright::lowering {

namespace {

using graphic::Block;
using graphic::Coil;
using graphic::CoilKind;
using graphic::Condition;
using graphic::ConditionKind;
using graphic::Edge;
using graphic::Rung;
using syntax::PieceKind;

// A text that is not what its place asks for.
struct BrokenPiece {
  std::string text;
  PieceKind kind = PieceKind::Word;
  std::size_t rung = 0;
  std::string fault;
};

// The texts of a ladder, each read before it is used.
class Pieces {
 public:
  // `place` marks the rung, for texts that bring no mark of their own.
  void begin_rung(const std::string& place) {
    place_ = place;
    ++rung_;
  }

  std::string word(const std::string& text) { return read(text, PieceKind::Word); }
  std::string pou(const std::string& text) { return read(text, PieceKind::PouName); }
  std::string variable(const std::string& text) { return read(text, PieceKind::Variable); }
  std::string expression(const std::string& text) { return read(text, PieceKind::Expression); }
  std::string statements(const std::string& text) { return read(text, PieceKind::StatementList); }

  // An expression beside an operator.
  std::string operand(const std::string& text) {
    bool is_operand = true;
    const std::string piece = read(text, PieceKind::Expression, &is_operand);
    return is_operand ? piece : "(" + piece + ")";
  }

  // The condition with texts that can stand in a line.
  Condition condition(Condition condition) {
    if (condition.kind == ConditionKind::Contact || condition.kind == ConditionKind::Comparison)
      condition.name = operand(condition.name);
    if (condition.kind == ConditionKind::Comparison) condition.operand = operand(condition.operand);
    if (condition.kind == ConditionKind::Expression) condition.name = expression(condition.name);
    for (Condition& child : condition.children) child = this->condition(std::move(child));
    return condition;
  }

  const std::vector<BrokenPiece>& broken() const { return broken_; }

 private:
  std::string read(const std::string& text, PieceKind kind, bool* is_operand = nullptr) {
    const syntax::Piece piece = reader_.read(text, kind);
    if (!piece.is_whole) {
      broken_.push_back({place_ + text, kind, rung_, piece.fault});
      return {};
    }
    if (is_operand != nullptr) *is_operand = piece.is_operand;
    return reader_.line(text);
  }

  syntax::PieceReader reader_;
  std::vector<BrokenPiece> broken_;
  std::string place_;
  std::size_t rung_ = 0;
};

class Writer {
 public:
  Writer(const graphic::LadderProgram& ladder, std::string prefix)
      : ladder_(ladder), prefix_(std::move(prefix)), variables_(ladder.wires) {}

  std::string text() {
    std::string all;
    for (const Rung& each : ladder_.rungs) {
      line_.clear();
      pieces_.begin_rung(each.place);
      const std::size_t broken = pieces_.broken().size();
      rung(each);
      // Nothing is made of a rung with a broken text.
      all += (pieces_.broken().size() == broken ? line_ : std::string()) + "\n";
    }
    return all;
  }

  std::vector<graphic::Wire> variables() {
    if (needs_power_) variables_.push_back({power(), "BOOL", false});
    return std::move(variables_);
  }

  std::size_t edges() const { return edges_; }
  const std::vector<BrokenPiece>& broken() const { return pieces_.broken(); }

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
    if (!rung.label.empty()) line_ += pieces_.word(rung.label) + ": ";
    const std::string condition = to_st(sensed(pieces_.condition(rung.condition)));
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
    if (!rung.jump_to.empty()) line_ += "IF " + power() + " THEN " + jump(rung) + "END_IF; ";
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
    line_ += rung.is_return ? "RETURN; " : jump(rung);
    return true;
  }

  std::string jump(const Rung& rung) { return "JMP " + pieces_.word(rung.jump_to) + "; "; }

  // The condition with each edge replaced by a variable that was computed before it.
  Condition sensed(const Condition& condition) {
    Condition result = condition;
    if (condition.kind == ConditionKind::Contact && condition.edge != Edge::None) {
      const std::string pulse = prefix_ + "PULSE" + std::to_string(pulses_++);
      variables_.push_back({pulse, "BOOL", false});
      const std::string state = new_edge();
      const bool rising = condition.edge == Edge::Rising;
      // The contact is read once: its text may be a call.
      line_ += pulse + " := " + (rising ? "NOT " : "") + state + "; " + state + " := " + condition.name +
               "; " + pulse + " := " + pulse + " AND " + (rising ? "" : "NOT ") + state + "; ";
      return graphic::contact(pulse, condition.negated);
    }
    for (Condition& child : result.children) child = sensed(child);
    return result;
  }

  bool direct_coil(const Coil& coil, const std::string& condition) {
    if (coil.kind == CoilKind::RisingEdge || coil.kind == CoilKind::FallingEdge) return false;
    const std::string variable = pieces_.variable(coil.variable);
    const char* negation = coil.kind == CoilKind::Negated || coil.kind == CoilKind::Reset ? "NOT " : "";
    line_ += variable + " := ";
    if (coil.kind == CoilKind::Set) line_ += variable + " OR ";
    if (coil.kind == CoilKind::Reset) line_ += variable + " AND ";
    line_ += coil.kind == CoilKind::Normal ? condition + "; " : negation + ("(" + condition + "); ");
    return true;
  }

  void coil(const Coil& coil) {
    if (direct_coil(coil, power())) return;
    const std::string state = new_edge();
    const bool rising = coil.kind == CoilKind::RisingEdge;
    line_ += pieces_.variable(coil.variable) +
             " := " + (rising ? power() + " AND NOT " + state : state + " AND NOT " + power()) + "; " +
             state + " := " + power() + "; ";
  }

  void block(const Block& block) {
    // A function says itself whether it had a value.
    const bool is_function = !block.type.empty() && block.instance.empty();
    std::string ends;
    std::string idle;
    for (const auto& [formal, variable] : block.outputs) {
      if (source::upper(formal) != "ENO" || variable.empty()) continue;
      if (is_function) idle += pieces_.variable(variable) + " := FALSE; ";
      if (!is_function) ends += pieces_.variable(variable) + " := " + power() + "; ";
    }
    const bool runs = !block.instance.empty() && !block.power_input.empty();
    const std::string body = call_text(block);
    if (!idle.empty()) idle = "ELSE " + idle;
    line_ += (runs ? body : "IF " + power() + " THEN " + body + idle + "END_IF; ") + ends;
  }

  std::string call_text(const Block& block) {
    if (block.type.empty()) return pieces_.statements(block.st_body) + "; ";
    if (!block.instance.empty()) return pieces_.variable(block.instance) + "(" + arguments(block, "") + "); ";
    const std::string result = result_of(block);
    return (result.empty() ? "" : pieces_.variable(result) + " := ") + pieces_.pou(block.type) + "(" +
           arguments(block, result) + "); ";
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

  std::string arguments(const Block& block, const std::string& result) {
    std::string list;
    const auto add = [&](const std::string& argument) { list += (list.empty() ? "" : ", ") + argument; };
    if (!block.power_input.empty()) add(pieces_.word(block.power_input) + " := " + power());
    for (const auto& [formal, text] : block.inputs) {
      if (source::upper(formal) == "EN" || text.empty()) continue;
      const std::string value = pieces_.expression(text);
      add(formal.empty() ? value : pieces_.word(formal) + " := " + value);
    }
    for (const auto& [formal, variable] : block.outputs) {
      const bool taken = !result.empty() && is_result(block, formal);
      const bool is_power = source::upper(formal) == "ENO" && !block.instance.empty();
      if (!taken && !is_power && !variable.empty())
        add(pieces_.word(formal) + " => " + pieces_.variable(variable));
    }
    return list;
  }

  const graphic::LadderProgram& ladder_;
  std::string prefix_;
  Pieces pieces_;
  std::vector<graphic::Wire> variables_;
  std::string line_;
  std::size_t edges_ = 0;
  std::size_t pulses_ = 0;
  bool needs_power_ = false;
};

// At its mark, or in the line of its rung. What can be read of it is kept for the analysis, so that one run
// reports all mistakes.
void report(const BrokenPiece& piece, const std::string& file_name, syntax::SyntaxContext& context,
            syntax::Statements& body) {
  const std::string lines(piece.rung > 0 ? piece.rung - 1 : 0, '\n');
  const source::FileId file = context.sources.add(file_name, lines + piece.text);
  auto parsed = syntax::parse_piece(context, file, piece.kind, syntax::TextKind::Generated);
  if (parsed.is_whole)
    context.sink.error(source::code::kUnexpectedToken, {file, static_cast<std::uint32_t>(lines.size())},
                       piece.fault);
  std::move(parsed.statements.begin(), parsed.statements.end(), std::back_inserter(body));
}

}  // namespace

LadderText ladder_text(const graphic::LadderProgram& ladder, const std::string& prefix) {
  Writer writer(ladder, prefix);
  LadderText result;
  result.statements = writer.text();
  result.variables = writer.variables();
  for (const BrokenPiece& each : writer.broken()) result.faults.push_back(each.fault);
  return result;
}

LadderStatements ladder_to_syntax(const graphic::LadderProgram& ladder, const std::string& file_name,
                                  bool keeps_state, syntax::SyntaxContext& context) {
  Writer writer(ladder, "__");
  // What the text of a chart lacks was reported when the chart was read.
  const bool told = context.sink.has_errors();
  const source::FileId file = context.sources.add(file_name, writer.text());
  LadderStatements result;
  if (writer.edges() > 0 && !keeps_state) {
    context.sink.error(source::code::kEdgeInFunction, {file, 0},
                       "a function keeps no state, so its rungs cannot sense edges", "use a function block");
    return result;
  }
  result.body = syntax::parse_statements(context, file, syntax::TextKind::Generated);
  source::DiagnosticSink silent(context.sources);
  syntax::SyntaxContext again{context.sources, context.names, told ? silent : context.sink, context.dialect};
  for (const BrokenPiece& each : writer.broken()) report(each, file_name, again, result.body);
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
