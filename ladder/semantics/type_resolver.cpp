// Types by name and by shape (IEC 61131-3, 6.4).

#include <algorithm>
#include <utility>

#include "ladder/semantics/internal/declarer.h"
#include "ladder/source/suggestion.h"

namespace stepwright::semantics::internal {

TypeResolver::TypeResolver(Analysis& analysis, const syntax::Unit& unit) : a_(analysis), unit_(unit) {
  for (const syntax::TypeDeclaration& each : unit.types) {
    ElementaryType elementary{};
    const bool taken = elementary_from(a_.names.folded(each.name.id), elementary) ||
                       a_.pous.count(each.name.id.value) != 0 ||
                       !known_.try_emplace(each.name.id.value, Known{&each, State::Open}).second;
    if (taken)
      a_.error(code::kDuplicate, each.name.where,
               "there is another type or POU named " + quote(each.name.text));
  }
}

void TypeResolver::declare_all() {
  for (const syntax::TypeDeclaration& each : unit_.types) named(each.name);
}

const Type* TypeResolver::resolve(const syntax::TypeSpec& spec) {
  switch (spec.kind) {
    case syntax::TypeKind::Named:
      return named(spec.name);
    case syntax::TypeKind::Array:
      return array(spec);
    case syntax::TypeKind::Struct:
      return structure(spec, "STRUCT");
    case syntax::TypeKind::Enumeration:
      return enumeration(spec, "enumeration");
    case syntax::TypeKind::Subrange:
    case syntax::TypeKind::Text:
    case syntax::TypeKind::Reference:
      a_.error(code::kNotSupported, spec.where, "this type is not supported yet");
      return nullptr;
    case syntax::TypeKind::Error:
      break;
  }
  return nullptr;
}

const Type* TypeResolver::named(const syntax::Name& name) {
  ElementaryType elementary{};
  if (elementary_from(a_.names.folded(name.id), elementary)) return a_.type_table().elementary(elementary);
  if (const auto known = known_.find(name.id.value); known != known_.end()) {
    if (known->second.state == State::Running) {
      a_.error(code::kRecursion, name.where, "the type " + quote(name.text) + " contains itself");
      return nullptr;
    }
    if (known->second.state == State::Open) {
      known->second.state = State::Running;
      const Type* type = declared(*known->second.declaration);
      known_.at(name.id.value).state = State::Done;
      a_.types[name.id.value] = type;
    }
    return a_.types[name.id.value];
  }
  if (const auto pou = a_.pous.find(name.id.value); pou != a_.pous.end()) {
    if (pou->second->kind != PouKind::FunctionBlock) {
      a_.error(code::kUnknownType, name.where,
               quote(name.text) + " is no type but a " +
                   (pou->second->kind == PouKind::Program ? "program" : "function"));
      return nullptr;
    }
    if (layouts_[name.id.value] == State::Running) {
      a_.error(code::kRecursion, name.where, "the function block " + quote(name.text) + " contains itself");
      return nullptr;
    }
    lay_out(*pou->second);
    return pou->second->type;
  }
  static constexpr std::string_view kLater[] = {"STRING", "WSTRING", "CHAR",          "WCHAR",
                                                "DATE",   "LDATE",   "TOD",           "TIME_OF_DAY",
                                                "LTOD",   "DT",      "DATE_AND_TIME", "LDT"};
  for (const std::string_view each : kLater) {
    if (a_.names.folded(name.id) != each) continue;
    a_.error(code::kNotSupported, name.where, "the type " + quote(name.text) + " is not supported yet");
    return nullptr;
  }
  std::vector<std::string> spellings;
  for (std::uint8_t i = 0; i < bytecode::kElementaryTypeCount; ++i)
    spellings.emplace_back(bytecode::name_of(static_cast<ElementaryType>(i)));
  for (const auto& each : unit_.types) spellings.emplace_back(each.name.text);
  for (const auto& each : a_.model.pous)
    if (each->kind == PouKind::FunctionBlock) spellings.push_back(each->spelling);
  a_.error(
      code::kUnknownType, name.where, "there is no type " + quote(name.text),
      source::did_you_mean(name.text, std::vector<std::string_view>(spellings.begin(), spellings.end())));
  return nullptr;
}

const Type* TypeResolver::declared(const syntax::TypeDeclaration& declaration) {
  const syntax::TypeSpec& spec = *declaration.type;
  std::string name(declaration.name.text);
  const Type* type = nullptr;
  if (spec.kind == syntax::TypeKind::Struct) {
    type = structure(spec, name);
  } else if (spec.kind == syntax::TypeKind::Enumeration) {
    type = enumeration(spec, name);
  } else {
    type = resolve(spec);
  }
  if (type == nullptr || !declaration.initial) return type;
  if (type->kind != TypeKind::Enumeration || spec.kind != syntax::TypeKind::Enumeration) {
    a_.error(code::kNotSupported, declaration.initial->where,
             "a first value for a type is supported for enumerations only", "give it to the variables");
    return nullptr;
  }
  ExpressionAnalyzer expressions(a_, nullptr);
  const auto value = expressions.constant(*declaration.initial, type);
  if (!value) return nullptr;
  auto* changed = const_cast<Type*>(type);  // made a moment ago, nobody has seen it
  changed->initial.assign(type->size, std::byte{0});
  store(*value, *type, changed->initial);
  return type;
}

const Type* TypeResolver::array(const syntax::TypeSpec& spec) {
  const Type* element = resolve(*spec.element);
  ExpressionAnalyzer expressions(a_, nullptr);
  std::vector<Dimension> dimensions;
  std::uint64_t size = element != nullptr ? element->size : 1;
  bool sound = element != nullptr;
  for (const syntax::ArrayRange& each : spec.ranges) {
    const auto low = expressions.constant_integer(*each.low);
    const auto high = expressions.constant_integer(*each.high);
    if (!low || !high) {
      sound = false;
      continue;
    }
    constexpr std::int64_t kBound = 1LL << 30;
    if (*high < *low || *low < -kBound || *high > kBound) {
      a_.error(code::kBadArrayBounds, each.low->where,
               "the bounds " + std::to_string(*low) + ".." + std::to_string(*high) + " hold no element",
               "the lower bound comes first");
      return nullptr;
    }
    dimensions.push_back({static_cast<std::int32_t>(*low), static_cast<std::int32_t>(*high)});
    size *= dimensions.back().count();
    if (size > kMaxData) {
      a_.error(code::kTooLarge, spec.where, "the array is larger than 32 MiB");
      return nullptr;
    }
  }
  return sound ? a_.type_table().array(element, std::move(dimensions)) : nullptr;
}

const Type* TypeResolver::structure(const syntax::TypeSpec& spec, std::string name) {
  Type* type = a_.type_table().create(TypeKind::Struct, std::move(name));
  type->size = 0;
  ExpressionAnalyzer expressions(a_, nullptr);
  bool sound = true;
  for (const syntax::VariableDeclaration& line : spec.fields) {
    const Type* field_type = resolve(*line.type);
    if (field_type == nullptr) {
      sound = false;
      continue;
    }
    if (field_type->kind == TypeKind::Instance) {
      a_.error(code::kBadSection, line.type->where, "a structure cannot hold function blocks");
      sound = false;
      continue;
    }
    for (const syntax::Name& each : line.names) {
      for (const Field& other : type->fields)
        if (other.name == each.id)
          a_.error(code::kDuplicate, each.where, "there is another member " + quote(each.text));
      type->fields.push_back({each.id, std::string(each.text), field_type, type->size});
      if (type->size > kMaxData - field_type->size) {
        a_.error(code::kTooLarge, each.where, "the structure is larger than 32 MiB");
        return nullptr;
      }
      type->size += field_type->size;
      type->initial.resize(type->size);
      const std::span<std::byte> bytes = std::span(type->initial).last(field_type->size);
      std::copy(field_type->initial.begin(), field_type->initial.end(), bytes.begin());
      if (line.initial) sound = initialise(a_, expressions, *line.initial, *field_type, bytes) && sound;
    }
  }
  if (type->fields.empty() && sound) {
    a_.error(code::kTooLarge, spec.where, "the structure has no members");
    return nullptr;
  }
  return sound ? type : nullptr;
}

const Type* TypeResolver::enumeration(const syntax::TypeSpec& spec, std::string name) {
  Type* type = a_.type_table().create(TypeKind::Enumeration, std::move(name));
  type->elementary = ElementaryType::Int;
  type->size = 2;
  ExpressionAnalyzer expressions(a_, nullptr);
  const Type* number = a_.type_table().elementary(ElementaryType::Int);
  std::int32_t next = 0;
  for (const syntax::Enumerator& each : spec.enumerators) {
    if (each.value) {
      const auto value = expressions.constant(*each.value, number);
      if (!value) return nullptr;
      next = static_cast<std::int32_t>(value->integer);
    }
    for (const Enumerator& other : type->enumerators)
      if (other.name == each.name.id)
        a_.error(code::kDuplicate, each.name.where, "there is another value " + quote(each.name.text));
    const auto value = static_cast<std::int16_t>(next++);
    type->enumerators.push_back({each.name.id, std::string(each.name.text), value});
    const auto [known, is_new] = a_.enum_values.try_emplace(each.name.id.value, EnumValue{type, value});
    if (!is_new) known->second.type = nullptr;
  }
  if (type->enumerators.front().value != 0) {
    type->initial.assign(2, std::byte{0});
    store({type->enumerators.front().value}, *type, type->initial);
  }
  return type;
}

}  // namespace stepwright::semantics::internal
