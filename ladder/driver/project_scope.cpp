#include "ladder/driver/project_scope.h"

#include <algorithm>
#include <utility>

#include "ladder/graphic/identifier.h"
#include "ladder/graphic/type_text.h"
#include "ladder/syntax/namespace_lookup.h"

namespace stepwright::driver {

namespace {

using graphic::upper;

// Types as ST text; those of namespaces by their full names.
class TypeTexts {
 public:
  TypeTexts(const syntax::Unit& unit, const source::NameTable& names) : names_(names), lookup_(names, unit) {}

  std::string of(const syntax::TypeSpec& type, const syntax::NameScope* scope) const {
    switch (type.kind) {
      case syntax::TypeKind::Named: {
        const auto found = lookup_.find(names_.folded(type.name.id), scope);
        return found && found->id != type.name.id ? names_.folded(found->id) : std::string(type.name.text);
      }
      case syntax::TypeKind::Array:
        return "ARRAY[] OF " + of(*type.element, scope);
      case syntax::TypeKind::Struct: {
        std::string text = "STRUCT ";
        for (const syntax::VariableDeclaration& line : type.fields)
          for (const syntax::Name& name : line.names)
            text += std::string(name.text) + " : " + of(*line.type, scope) + "; ";
        return text + "END_STRUCT";
      }
      case syntax::TypeKind::Text:
        return std::string(type.name.text);
      default:
        return {};
    }
  }

 private:
  const source::NameTable& names_;
  syntax::NamespaceLookup lookup_;
};

void add_parameter(lowering::Signature& signature, syntax::Section section, lowering::Parameter parameter) {
  if (section == syntax::Section::Input)
    signature.inputs.push_back(std::move(parameter));
  else if (section == syntax::Section::Output)
    signature.outputs.push_back(std::move(parameter));
  else if (section == syntax::Section::InOut)
    signature.in_outs.push_back(std::move(parameter));
}

// Behind the index that begins with the first of the tokens; 0 if it is not closed.
std::size_t index_length(std::span<const syntax::Token> tokens) {
  int depth = 0;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i].is(syntax::TokenKind::LeftBracket)) ++depth;
    if (tokens[i].is(syntax::TokenKind::RightBracket) && --depth == 0) return i + 1;
  }
  return 0;
}

}  // namespace

void ProgramInterfaces::add(const syntax::Unit& unit, const source::NameTable& names) {
  const TypeTexts texts(unit, names);
  for (const syntax::TypeDeclaration& type : unit.types)
    if (type.type) types_[upper(std::string(type.name.text))] = texts.of(*type.type, type.scope);
  for (const syntax::PouDeclaration& pou : unit.pous) {
    lowering::Signature& signature = pous_[upper(std::string(pou.name.text))];
    signature = {};
    signature.is_function = pou.kind == syntax::PouKind::Function;
    if (pou.result) signature.result = texts.of(*pou.result, pou.scope);
    for (const syntax::VariableDeclaration& line : pou.variables)
      for (const syntax::Name& name : line.names)
        add_parameter(signature, line.section, {std::string(name.text), texts.of(*line.type, pou.scope)});
  }
  std::size_t at = 0;
  for (const syntax::GlobalScope& each : unit.global_scopes)
    for (; at < each.end; ++at)
      for (const syntax::Name& name : unit.globals[at].names)
        globals_[upper(std::string(name.text))] = texts.of(*unit.globals[at].type, each.scope);
}

void ProgramInterfaces::add(const graphic::Project& project) {
  for (const graphic::DataType& type : project.types) types_[upper(type.name)] = type.type;
  for (const graphic::Variable& variable : project.globals) globals_[upper(variable.name)] = variable.type;
  for (const graphic::Resource& resource : project.resources)
    for (const graphic::Variable& variable : resource.globals) globals_[upper(variable.name)] = variable.type;
  for (const graphic::Pou& pou : project.pous) {
    lowering::Signature& signature = pous_[upper(pou.name)];
    signature = {};
    signature.is_function = pou.kind == graphic::PouKind::Function;
    signature.result = pou.result_type;
    for (const graphic::Variable& each : pou.variables) {
      const lowering::Parameter parameter{each.name, each.type};
      if (each.section == graphic::VariableSection::Input) signature.inputs.push_back(parameter);
      if (each.section == graphic::VariableSection::Output) signature.outputs.push_back(parameter);
      if (each.section == graphic::VariableSection::InOut) signature.in_outs.push_back(parameter);
    }
  }
}

const lowering::Signature* ProgramInterfaces::signature(const std::string& type) const {
  const auto found = pous_.find(upper(type));
  return found == pous_.end() ? nullptr : &found->second;
}

std::string ProgramInterfaces::type_of_global(const std::string& name) const {
  const auto found = globals_.find(upper(name));
  return found == globals_.end() ? std::string() : found->second;
}

std::string ProgramInterfaces::type_behind(std::string name) const {
  for (int hops = 0; hops < 20; ++hops) {
    const auto alias = types_.find(upper(name));
    if (alias == types_.end()) break;
    name = alias->second;
  }
  return name;
}

std::string ProgramInterfaces::type_below(std::string base, std::span<const syntax::Token> path) const {
  while (!path.front().is(syntax::TokenKind::End) && !base.empty()) {
    base = type_behind(std::move(base));
    if (path.front().is(syntax::TokenKind::LeftBracket)) {
      const std::size_t length = index_length(path);
      if (length == 0) return {};
      base = graphic::element_type(base);
      path = path.subspan(length);
    } else if (path.front().is(syntax::TokenKind::Dot) && path[1].is(syntax::TokenKind::Identifier)) {
      base = type_of_member(base, path[1].text);
      path = path.subspan(2);
    } else {
      return {};
    }
  }
  return base;
}

std::string ProgramInterfaces::type_of_member(const std::string& base, std::string_view name) const {
  std::string type;
  if (graphic::is_structure(base)) {
    for (const graphic::StructureMember& each : graphic::members_of(base))
      if (graphic::same_name(each.name, name)) type = each.type;
  } else if (const lowering::Signature* block = signature(base)) {
    for (const auto* list : {&block->outputs, &block->inputs, &block->in_outs})
      for (const lowering::Parameter& each : *list)
        if (graphic::same_name(each.name, name)) type = each.type;
  }
  return type;
}

std::string ProjectScope::type_of(const std::string& variable) const {
  const std::vector<syntax::Token> tokens = reader_.tokens(variable);
  if (!tokens.front().is(syntax::TokenKind::Identifier)) return {};
  const std::string_view name = tokens.front().text;
  std::string type;
  for (const graphic::Variable& each : pou_.variables)
    if (graphic::same_name(each.name, name)) type = each.type;
  if (type.empty() && pou_.kind == graphic::PouKind::Function && graphic::same_name(pou_.name, name))
    type = pou_.result_type;
  if (type.empty()) type = interfaces_.type_of_global(std::string(name));
  return interfaces_.type_below(type, std::span(tokens).subspan(1));
}

bool ProjectScope::is_private(const std::string& variable) const {
  using graphic::VariableSection;
  return std::any_of(pou_.variables.begin(), pou_.variables.end(), [&](const graphic::Variable& each) {
    return graphic::same_name(each.name, variable) && each.address.empty() &&
           each.section != VariableSection::InOut && each.section != VariableSection::External &&
           each.section != VariableSection::Global;
  });
}

std::string ProjectScope::mark(std::uint32_t where) const {
  if (!marks_ || where == 0) return {};
  return "{@" + std::to_string(file_.value) + ":" + std::to_string(where) + "!}";
}

result::Location ProjectScope::location(std::uint32_t where) const {
  return where == 0 ? result::Location{} : context_.sources.location({file_, where});
}

void ProjectScope::note(std::uint32_t where, const std::string& what) {
  if (where != 0) context_.sources.add_note({file_, where}, "POU '" + pou_.name + "', " + what);
}

std::string ProjectScope::piece(const graphic::SourceText& text, syntax::PieceKind kind,
                                std::uint32_t where) {
  if (!marks_) return text.text;
  if (text.anchors.empty()) {
    const syntax::Piece piece = reader_.read(text.text, kind);
    if (!piece.is_whole) error(source::code::kUnexpectedToken, where, piece.fault, piece.hint);
    return piece.is_whole ? reader_.bare_line(text.text) : std::string();
  }
  const source::FileId file = add_text(context_.sources, file_, {}, text);
  if (!syntax::parse_piece(context_, file, kind, syntax::TextKind::Piece).is_whole) return {};
  return "{@" + std::to_string(file.value) + ":0}" + reader_.bare_line(text.text) + "{@}";
}

void ProjectScope::error(const char* code, std::uint32_t where, std::string message, std::string hint) {
  const std::string pou = where == 0 ? "POU '" + pou_.name + "': " : std::string();
  context_.sink.error(code, {file_, where}, pou + message, std::move(hint));
}

void ProjectScope::warning(const char* code, std::uint32_t where, std::string message, std::string hint) {
  context_.sink.warning(code, {file_, where}, std::move(message), std::move(hint));
}

source::FileId add_text(source::SourceSet& sources, source::FileId file, const std::string& name,
                        const graphic::SourceText& text) {
  if (text.anchors.empty()) return sources.add(name, text.text);
  std::vector<source::Anchor> anchors;
  for (const graphic::TextAnchor& each : text.anchors) anchors.push_back({each.text, each.file});
  return sources.add_piece(text.text, file, std::move(anchors));
}

}  // namespace stepwright::driver
