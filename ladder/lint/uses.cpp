#include "ladder/lint/internal/uses.h"

namespace stepwright::lint::internal {

using semantics::Pou;
using semantics::Section;

Uses::Uses(const semantics::Model& program, const syntax::Unit& declarations, std::size_t users)
    : model(program), unit(declarations), user_pous(users), has_side_effects(program.pous.size()) {
  for (std::size_t i = 0; i < model.globals.size(); ++i) {
    of_globals.push_back({.variable = &model.globals[i]});
    global_index.try_emplace(model.globals[i].name.value, i);
  }
  of_pous.resize(model.pous.size());
  for (std::size_t i = 0; i < model.pous.size(); ++i) {
    const Pou& pou = *model.pous[i];
    if (pou.declaration == nullptr) continue;  // made by the analysis, to run a connected program
    pou_index.try_emplace(pou.name.value, i);
    for (const semantics::Variable& each : pou.variables) of_pous[i].push_back({.variable = &each});
    for (const syntax::VariableDeclaration& line : pou.declaration->variables) {
      for (const syntax::Name& name : line.names) {
        const auto found = pou.scope.find(name.id.value);
        if (found == pou.scope.end()) continue;
        of_pous[i][found->second].initialised = line.initial != nullptr;
        of_pous[i][found->second].generated = line.generated;
      }
    }
  }
}

VariableUse* Uses::find(std::size_t pou, NameId name) {
  const auto global = [&]() -> VariableUse* {
    const auto found = global_index.find(name.value);
    return found == global_index.end() ? nullptr : &of_globals[found->second];
  };
  const auto& scope = model.pous[pou]->scope;
  const auto own = scope.find(name.value);
  if (own == scope.end()) return global();
  VariableUse& use = of_pous[pou][own->second];
  if (use.variable->section != Section::External) return &use;
  use.named = true;
  return global();
}

BitRange range_of(const syntax::DirectAddress& address) {
  return {static_cast<std::uint8_t>(address.area), address.byte * 8 + address.bit, address.bits};
}

BitRange range_of(const semantics::Variable& variable) {
  BitRange range = range_of(*variable.address);
  const bool one_bit = std::get<2>(range) == 1;
  if (!one_bit) std::get<2>(range) = variable.type->size * 8;
  return range;
}

std::string quote(std::string_view name) {
  return "'" + std::string(name) + "'";
}

}  // namespace stepwright::lint::internal
