#include "ladder/driver/extension_types.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace stepwright::driver {

namespace {

struct Extension {
  std::string_view name;
  std::string_view base;         // of a type; empty: a block
  std::string_view inputs = {};  // of a block
  std::string_view outputs = "ACK : BOOL; RESULT : STRING;";
};

constexpr std::string_view kPython = "TRIG : BOOL; CODE : STRING;";

constexpr Extension kExtensions[] = {
    {"HMI_BOOL", "BOOL"},
    {"HMI_NODE", "BOOL"},
    {"HMI_SINT", "SINT"},
    {"HMI_INT", "INT"},
    {"HMI_DINT", "DINT"},
    {"HMI_LINT", "LINT"},
    {"HMI_USINT", "USINT"},
    {"HMI_UINT", "UINT"},
    {"HMI_UDINT", "UDINT"},
    {"HMI_ULINT", "ULINT"},
    {"HMI_REAL", "REAL"},
    {"HMI_STRING", "STRING"},
    {"LOGLEVEL", "(CRITICAL, WARNING, INFO, DEBUG) := INFO"},
    {"LOGGER", "", "TRIG : BOOL; MSG : STRING; LEVEL : LOGLEVEL;", ""},
    {"PYTHON_EVAL", "", kPython},
    {"PYTHON_POLL", "", kPython},
    {"PYTHON_GEAR", "", "N : UINT; TRIG : BOOL; CODE : STRING;"},
    {"CSV_READ_BY_INT", "", "FILE_NAME : STRING; ROW : INT; COLUMN : INT;"},
    {"CSV_READ_BY_STRING", "", "FILE_NAME : STRING; ROW : STRING; COLUMN : STRING;"},
    {"CSV_RELOAD", "", "TRIG : BOOL;"},
};

std::string section(std::string_view word, std::string_view variables) {
  return variables.empty() ? std::string() : std::string(word) + " " + std::string(variables) + " END_VAR\n";
}

std::string text_of(const Extension& each) {
  const std::string name(each.name);
  if (!each.base.empty()) return "TYPE " + name + " : " + std::string(each.base) + "; END_TYPE\n";
  return "FUNCTION_BLOCK " + name + "\n" + section("VAR_INPUT", each.inputs) +
         section("VAR_OUTPUT", each.outputs) + "END_FUNCTION_BLOCK\n";
}

}  // namespace

bool is_extension_type(std::string_view name) {
  return std::ranges::any_of(kExtensions, [&](const Extension& each) { return each.name == name; });
}

void add_extension_types(syntax::SyntaxContext& context, syntax::Unit& unit) {
  std::string text;
  const auto is_wanted = [&](const Extension& each) {
    const auto id = context.names.find(each.name);
    const auto is_it = [&](const auto& declared) { return declared.name.id == *id; };
    return id && !std::ranges::any_of(unit.types, is_it) && !std::ranges::any_of(unit.pous, is_it);
  };
  // A block comes behind the types that it names.
  bool logs = false;
  for (const Extension& each : kExtensions) logs = logs || (each.name == "LOGGER" && is_wanted(each));
  if (logs) context.names.intern("LOGLEVEL");
  for (const Extension& each : kExtensions)
    if (is_wanted(each)) text += text_of(each);
  if (text.empty()) return;
  const source::FileId file =
      context.sources.add("library/extension_types.st", std::move(text), source::Author::Library);
  syntax::parse_unit(context, file, unit);
}

}  // namespace stepwright::driver
