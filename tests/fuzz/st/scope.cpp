#include "tests/fuzz/st/scope.h"

#include <algorithm>

namespace stepwright::st_fuzz {

bool holds_block(const Type& type) {
  if (type.kind == TypeKind::Block) return true;
  if (type.kind == TypeKind::Array) return holds_block(*type.element);
  return std::ranges::any_of(type.fields, [](const Field& each) { return holds_block(*each.type); });
}

Scope::Scope(const Pou& pou) {
  for (const Variable& each : pou.variables) {
    // Inputs are the caller's to set.
    walk({&each, {}, each.type, each.writable && each.section != Section::Input});
  }
}

void Scope::walk(const Way& way) {
  const auto further = [&](const std::string& field, const Type* array, const Type* type, bool write) {
    Way next = way;
    next.steps.push_back({field, array});
    next.type = type;
    next.writable = way.writable && write;
    walk(next);
  };
  switch (way.type->kind) {
    case TypeKind::Enumeration:
      enumerations.push_back(way);
      break;
    case TypeKind::Elementary:
    case TypeKind::Subrange:
      readable[static_cast<unsigned>(way.type->scalar)].push_back(way);
      break;
    case TypeKind::Array:
      if (!holds_block(*way.type)) aggregates.push_back(way);
      return further("", way.type, way.type->element, true);
    case TypeKind::Struct:
      aggregates.push_back(way);
      for (const Field& each : way.type->fields) further(each.name, nullptr, each.type, true);
      return;
    case TypeKind::Block:
      blocks.push_back(way);
      for (const Variable& each : way.type->block->variables)
        if (each.section == Section::Output) further(each.name, nullptr, each.type, false);
      return;
  }
  if (way.writable) writable.push_back(way);
}

}  // namespace stepwright::st_fuzz
