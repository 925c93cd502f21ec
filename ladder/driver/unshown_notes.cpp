#include "ladder/driver/unshown_notes.h"

#include <string>
#include <unordered_map>

#include "ladder/source/codes.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::driver {

namespace {

using semantics::Section;
using semantics::TypeKind;
using semantics::Variable;

// Of its elements, if it is an array.
const semantics::Type& single(const semantics::Type& type) {
  return type.kind == TypeKind::Array && type.element != nullptr ? single(*type.element) : type;
}

struct Reason {
  std::string why;
  std::string hint;
};

// What names of values (syntax::TagPragma::values) mean nothing for.
Reason misnamed(const semantics::Type& type, std::size_t names) {
  if (names == 0) return {};
  if (type.is_bool())
    return names > 2 ? Reason{"a BOOL has two values, and " + std::to_string(names) + " names here", ""}
                     : Reason{};
  const bool whole = type.is_integer() || type.is_bits() || type.kind == TypeKind::Enumeration;
  return whole ? Reason{} : Reason{"only BOOL and whole numbers have names of values", ""};
}

Reason reason_of(const Variable& variable, bool of_function, const graphic::TagNote& note) {
  const std::string name = variable.spelling;
  if (of_function) return {"a variable of a function is no tag", "leave the pragma out"};
  if (variable.section == Section::Temp) return {"VAR_TEMP is no tag", "leave the pragma out"};
  if (variable.section == Section::External)
    return {"the tag is the global variable", "say it where VAR_GLOBAL declares '" + name + "'"};
  if (variable.type == nullptr) return {};
  const std::string hint = "describe its members: [tags] of the cell, 'PROGRAM." + name + ".MEMBER'";
  const semantics::Type& type = single(*variable.type);
  switch (type.kind) {
    case TypeKind::Instance:
      return {"an instance has no value of its own", hint};
    case TypeKind::Struct:
      return {"a structure has no value of its own", hint};
    default:
      return misnamed(type, note.values.size());
  }
}

bool is_global(const graphic::Sheet& sheet) {
  return sheet.kind == "VAR_GLOBAL" || sheet.kind == "CONFIGURATION";
}

}  // namespace

void warn_of_unshown_notes(const std::vector<graphic::Sheet>& sheets, const semantics::Model& model,
                           source::DiagnosticSink& sink) {
  std::unordered_map<std::string, const semantics::Pou*> pous;
  for (const auto& pou : model.pous) pous.emplace(naming::upper(pou->spelling), pou.get());
  for (const graphic::Sheet& sheet : sheets) {
    if (sheet.notes.empty()) continue;
    const auto pou = is_global(sheet) ? pous.end() : pous.find(naming::upper(sheet.name));
    if (!is_global(sheet) && pou == pous.end()) continue;
    const bool of_function = pou != pous.end() && pou->second->kind == semantics::PouKind::Function;
    std::unordered_map<std::string, const graphic::TagNote*> noted;
    for (const auto& note : sheet.notes) noted.emplace(naming::upper(note.first), &note.second);
    for (const Variable& each : pou != pous.end() ? pou->second->variables : model.globals) {
      const auto note = noted.find(naming::upper(each.spelling));
      if (note == noted.end()) continue;
      const Reason reason = reason_of(each, of_function, *note->second);
      if (reason.why.empty()) continue;
      sink.warning(source::code::kLoneTagPragma, each.where,
                   "what a pragma says of '" + each.spelling + "' is not shown: " + reason.why, reason.hint);
    }
  }
}

}  // namespace stepwright::driver
