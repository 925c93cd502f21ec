#include "ladder/lowering/shown_text.h"

#include "ladder/graphic/identifier.h"

namespace stepwright::lowering {

namespace {

using graphic::Block;
using graphic::Coil;
using graphic::CoilKind;
using graphic::Rung;

std::string under(const std::string& power, const std::string& statement) {
  return power == "TRUE" ? statement + ";\n" : "IF " + power + " THEN " + statement + "; END_IF;\n";
}

std::string coil_text(const Coil& coil, const std::string& power) {
  const std::string write = coil.variable + " := ";
  switch (coil.kind) {
    case CoilKind::Normal:
      return write + power + ";\n";
    case CoilKind::Negated:
      return write + "NOT (" + power + ");\n";
    case CoilKind::Set:
      return under(power, write + "TRUE");
    case CoilKind::Reset:
      return under(power, write + "FALSE");
    case CoilKind::RisingEdge:
      return write + "R_EDGE(" + power + ");\n";
    case CoilKind::FallingEdge:
      return write + "F_EDGE(" + power + ");\n";
  }
  return {};
}

std::string block_text(const Block& block, const std::string& power) {
  if (block.type.empty()) return under(power, block.st_body);
  std::string list;
  const auto add = [&](const std::string& formal, const char* sign, const std::string& text) {
    list += (list.empty() ? "" : ", ") + (formal.empty() ? "" : formal + sign) + text;
  };
  if (!block.power_input.empty()) add(block.power_input, " := ", power);
  for (const auto& [formal, text] : block.inputs)
    if (!text.empty()) add(formal, " := ", text);
  std::string result;
  for (const auto& [formal, variable] : block.outputs) {
    const bool is_result = block.instance.empty() && (formal.empty() || graphic::same_name(formal, "OUT") ||
                                                      graphic::same_name(formal, block.type));
    if (is_result)
      result = variable + " := ";
    else if (!variable.empty())
      add(formal, " => ", variable);
  }
  const std::string call = result + (block.instance.empty() ? block.type : block.instance) + "(" + list + ")";
  return block.power_input.empty() ? under(power, call) : call + ";\n";
}

}  // namespace

std::string shown_text(const graphic::LadderProgram& ladder) {
  std::string text;
  for (const Rung& rung : ladder.rungs) {
    const std::string power = to_st(rung.condition);
    for (const Block& each : rung.blocks) text += block_text(each, power);
    for (const Coil& each : rung.coils) text += coil_text(each, power);
  }
  return text;
}

}  // namespace stepwright::lowering
