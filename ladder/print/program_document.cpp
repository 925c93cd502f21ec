#include "ladder/print/program_document.h"

#include <nlohmann/json.hpp>
#include <set>

#include "ladder/graphic/identifier.h"
#include "ladder/print/body_json.h"
#include "ladder/print/body_uses.h"

namespace stepwright::print {

namespace {

using nlohmann::ordered_json;

// What is not said is left out.
ordered_json note_json(const graphic::TagNote& note) {
  ordered_json json = ordered_json::object();
  if (!note.unit.empty()) json["unit"] = note.unit;
  if (!note.description.empty()) json["description"] = note.description;
  if (!note.group.empty()) json["group"] = note.group;
  if (note.decimals) json["decimals"] = *note.decimals;
  if (note.range) json["range"] = {note.range->first, note.range->second};
  if (!note.values.empty()) json["values"] = note.values;
  return json;
}

ordered_json variable_json(const graphic::Variable& variable, const graphic::Sheet& sheet) {
  ordered_json json = {
      {"name", variable.name}, {"type", variable.type}, {"section", graphic::keyword_of(variable.section)}};
  if (!variable.address.empty()) json["address"] = variable.address;
  if (!variable.initial.empty()) json["initial"] = variable.initial;
  if (!variable.comment.empty()) json["comment"] = variable.comment;
  if (const auto note = sheet.notes.find(variable.name); note != sheet.notes.end())
    json["note"] = note_json(note->second);
  return json;
}

bool has_variables(const graphic::Sheet& sheet) {
  return sheet.kind != "TYPE" && sheet.kind != "CONFIGURATION";
}

// Names that every sheet may use.
std::set<std::string> globals_of(const std::vector<graphic::Sheet>& sheets) {
  std::set<std::string> names;
  for (const graphic::Sheet& sheet : sheets) {
    for (const graphic::Variable& each : sheet.variables)
      if (each.section == graphic::VariableSection::Global) names.insert(graphic::upper(each.name));
  }
  return names;
}

// What can be told apart from functions, members and types. Steps are variables: "S1.X".
std::set<std::string> names_of(const graphic::Sheet& sheet) {
  std::set<std::string> names;
  for (const graphic::Variable& each : sheet.variables) names.insert(graphic::upper(each.name));
  if (!sheet.result_type.empty()) names.insert(graphic::upper(sheet.name));
  if (const auto* chart = std::get_if<graphic::SfcChart>(&sheet.body)) {
    for (const graphic::Step& each : chart->steps) names.insert(graphic::upper(each.name));
    for (const graphic::Action& each : chart->actions) names.insert(graphic::upper(each.name));
  }
  return names;
}

ordered_json uses_json(const graphic::Sheet& sheet, const std::set<std::string>& globals) {
  ordered_json list = ordered_json::array();
  if (!has_variables(sheet)) return list;
  const std::set<std::string> own = names_of(sheet);
  for (const BodyUse& each : sheet.drawn ? diagram_uses(*sheet.drawn) : body_uses(sheet)) {
    const std::string name = graphic::upper(each.use.name);
    const bool known = each.drawn || name.starts_with('%') || own.contains(name) || globals.contains(name);
    if (!known) continue;
    const char* access = each.use.call ? "call" : each.use.write ? "write" : "read";
    list.push_back({each.use.path, access, each.block, each.use.line, each.use.column, each.use.length});
  }
  return list;
}

ordered_json sheet_json(const graphic::Sheet& sheet, const std::set<std::string>& globals) {
  ordered_json json = {{"name", sheet.name}, {"kind", sheet.kind}, {"language", language_of(sheet)}};
  if (!sheet.result_type.empty()) json["result"] = sheet.result_type;
  if (!sheet.file.empty()) json["file"] = sheet.file;
  if (!sheet.comment.empty()) json["comment"] = sheet.comment;
  json["variables"] = ordered_json::array();
  for (const graphic::Variable& each : sheet.variables)
    json["variables"].push_back(variable_json(each, sheet));
  json["blocks"] = blocks_json(sheet);
  json["uses"] = uses_json(sheet, globals);
  return json;
}

}  // namespace

std::string program_document(const std::vector<graphic::Sheet>& sheets) {
  const std::set<std::string> globals = globals_of(sheets);
  ordered_json document = {{"version", 1}, {"sheets", ordered_json::array()}};
  for (const graphic::Sheet& each : sheets) document["sheets"].push_back(sheet_json(each, globals));
  return document.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace stepwright::print
