// Names that hide others.

#include "ladder/lint/internal/rules.h"
#include "ladder/source/codes.h"

namespace stepwright::lint::internal {

namespace code = source::code;

namespace {

// What a name means outside of the POU: "global variable", "POU", ...
std::unordered_map<std::uint32_t, const char*> outer_names(const Uses& uses) {
  std::unordered_map<std::uint32_t, const char*> names;
  for (const VariableUse& each : uses.of_globals)
    names.try_emplace(each.variable->name.value, "a global variable");
  for (std::size_t i = 0; i < uses.user_pous; ++i) names.try_emplace(uses.model.pous[i]->name.value, "a POU");
  for (const syntax::TypeDeclaration& type : uses.unit.types) {
    names.try_emplace(type.name.id.value, "a type");
    if (!type.type || type.type->kind != syntax::TypeKind::Enumeration) continue;
    for (const syntax::Enumerator& each : type.type->enumerators)
      names.try_emplace(each.name.id.value, "a value of an enumeration");
  }
  return names;
}

}  // namespace

void check_hidden(const Uses& uses, source::DiagnosticSink& sink) {
  const auto names = outer_names(uses);
  for (std::size_t i = 0; i < uses.user_pous; ++i) {
    const semantics::Pou& pou = *uses.model.pous[i];
    for (const VariableUse& each : uses.of_pous[i]) {
      const semantics::Variable& variable = *each.variable;
      if (variable.section == semantics::Section::External || variable.name == pou.name) continue;
      const auto hidden = names.find(variable.name.value);
      if (hidden == names.end()) continue;
      sink.warning(code::kHidingName, variable.where,
                   quote(variable.spelling) + " hides " + hidden->second + " of the same name");
    }
  }
}

}  // namespace stepwright::lint::internal
