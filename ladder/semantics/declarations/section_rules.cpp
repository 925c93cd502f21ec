// Which variables may stand in which section (IEC 61131-3, 6.5.1 and tables 13 to 16).

#include "ladder/semantics/declarations/layout.h"

namespace stepwright::semantics::internal {

using syntax::VariableDeclaration;

const char* section_name(Section section) {
  static constexpr const char* kNames[] = {"VAR",        "VAR_TEMP",     "VAR_INPUT", "VAR_OUTPUT",
                                           "VAR_IN_OUT", "VAR_EXTERNAL", "VAR_GLOBAL"};
  return kNames[static_cast<std::size_t>(section)];
}

bool Layout::allowed(const VariableDeclaration& line, const Type& type) {
  const Position where = line.names.empty() ? line.address_where : line.names.front().where;
  std::string why;
  if (pou_.test != nullptr && line.section != Section::Local && line.section != Section::External) {
    why =
        std::string(section_name(line.section)) + " has no meaning in a TEST, which nothing calls: write VAR";
  } else if (line.section == Section::Global) {
    why = "VAR_GLOBAL stands in a configuration or outside of POUs";
  } else if (type.kind == TypeKind::Instance) {
    why = forbidden_block(line);
  }
  if (why.empty()) why = forbidden_qualifier(line, type);
  if (why.empty()) return address_allowed(line);
  a_.error(code::kBadSection, where, why);
  return false;
}

std::string Layout::forbidden_block(const VariableDeclaration& line) const {
  const bool is_function = pou_.kind == PouKind::Function;
  const bool elsewhere = line.section == Section::InOut || line.section == Section::External;
  if ((is_function || line.section == Section::Temp) && !elsewhere)
    return "a function block keeps its state and cannot live in a " +
           std::string(is_function ? "function" : "VAR_TEMP");
  if (line.constant) return "a function block cannot be CONSTANT";
  return {};
}

std::string Layout::forbidden_qualifier(const VariableDeclaration& line, const Type& type) const {
  const std::string section = section_name(line.section);
  const bool passed = line.section == Section::InOut || line.section == Section::External;
  const bool kept =
      line.section == Section::Local || line.section == Section::Input || line.section == Section::Output;
  if (line.constant && (line.section == Section::InOut || line.section == Section::Output))
    return section + " cannot be CONSTANT";
  if (line.initial && passed) return section + " takes no first value";
  if (line.initial && type.open) return "an ARRAY[*] takes no first value";
  if ((line.retain || line.non_retain) && (!kept || pou_.kind == PouKind::Function))
    return (pou_.kind == PouKind::Function ? "a function" : section) + " keeps nothing that could be RETAIN";
  if (line.constant && line.retain) return "a CONSTANT needs no RETAIN";
  if (line.edge == syntax::Edge::None) return {};
  if (!type.is_bool()) return "R_EDGE and F_EDGE stand behind BOOL, not behind " + type.name;
  if (line.section != Section::Input || pou_.kind == PouKind::Function)
    return "R_EDGE and F_EDGE stand in VAR_INPUT of a function block or a program";
  return {};
}

bool Layout::address_allowed(const VariableDeclaration& line) {
  const bool is_program = pou_.kind == PouKind::Program;
  const bool is_local = line.section == Section::Local;
  if (line.address && !(is_program && is_local)) {
    a_.error(
        code::kAddressNotHere, line.address_where, "an address stands in VAR of a program or in VAR_GLOBAL",
        pou_.kind == PouKind::FunctionBlock ? "write AT %I*, %Q* or %M*, and the address in VAR_CONFIG" : "");
    return false;
  }
  if (line.open_address && (pou_.kind == PouKind::Function || !is_local)) {
    a_.error(code::kAddressNotHere, line.address_where,
             "an open address stands in VAR of a program or a function block");
    return false;
  }
  return true;
}

}  // namespace stepwright::semantics::internal
