#include "ladder/driver/foreign_types.h"

#include <algorithm>
#include <string_view>

#include "ladder/driver/extension_types.h"
#include "ladder/semantics/types/type.h"
#include "ladder/source/codes.h"
#include "ladder/source/suggestion.h"

namespace stepwright::driver {

ForeignTypes::ForeignTypes(const syntax::Unit& unit, syntax::SyntaxContext& context) : context_(context) {
  for (const syntax::TypeDeclaration& each : unit.types) known_.insert(each.name.id);
  // What is a POU but no function block has a diagnostic of its own.
  for (const syntax::PouDeclaration& each : unit.pous) known_.insert(each.name.id);
}

void ForeignTypes::collect(syntax::TypeSpec& spec, std::vector<syntax::Name>& missing) const {
  if (spec.element) collect(*spec.element, missing);
  for (syntax::VariableDeclaration& field : spec.fields)
    if (field.type) collect(*field.type, missing);
  if (spec.kind != syntax::TypeKind::Named || known_.count(spec.name.id) != 0) return;
  const std::string& name = context_.names.folded(spec.name.id);
  semantics::ElementaryType elementary{};
  if (name == "STRING" || name == "WSTRING" || semantics::elementary_from(name, elementary)) return;
  missing.push_back(spec.name);
  spec.kind = syntax::TypeKind::Error;
}

void ForeignTypes::report(std::span<syntax::VariableDeclaration> variables) const {
  std::vector<syntax::Name> missing;
  for (syntax::VariableDeclaration& each : variables)
    if (each.type) collect(*each.type, missing);
  if (missing.empty()) return;
  std::string list;
  std::set<source::NameId> named;
  for (const syntax::Name& each : missing)
    if (named.insert(each.id).second) list += (list.empty() ? "'" : ", '") + std::string(each.text) + "'";
  std::vector<std::string_view> candidates;
  for (const source::NameId each : known_) candidates.push_back(context_.names.folded(each));
  std::string hint =
      named.size() == 1 ? source::did_you_mean(missing.front().text, candidates) : std::string();
  if (hint.empty())
    hint =
        "what another system brings along (HMI_INT, python_eval) has to be declared here: add an ST file or "
        "project";
  const auto is_extension = [&](const syntax::Name& each) {
    return is_extension_type(context_.names.folded(each.id));
  };
  if (std::ranges::all_of(missing, is_extension))
    hint = source::with_dialects(std::move(hint), &source::Dialect::extension_types);
  context_.sink.error(
      source::code::kUnknownType, missing.front().where,
      (named.size() == 1 ? "the type " + list + " is" : "the types " + list + " are") + " declared nowhere",
      std::move(hint));
}

}  // namespace stepwright::driver
