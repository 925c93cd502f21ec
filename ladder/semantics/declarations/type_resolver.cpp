// Types by name and by shape (IEC 61131-3, 6.4).

#include <algorithm>
#include <utility>

#include "ladder/semantics/declarations/declarer.h"
#include "ladder/source/suggestion.h"

namespace stepwright::semantics::internal {

TypeResolver::TypeResolver(Analysis& analysis, const syntax::Unit& unit) : a_(analysis), unit_(unit) {
  for (const syntax::TypeDeclaration& each : unit.types) {
    ElementaryType elementary{};
    const std::string& folded = a_.names.folded(each.name.id);
    const bool taken = elementary_from(folded, elementary) || folded == "STRING" || folded == "WSTRING" ||
                       a_.pous.count(each.name.id.value) != 0 ||
                       !known_.try_emplace(each.name.id.value, Known{&each, State::Open, {}}).second;
    if (taken)
      a_.error(code::kDuplicate, each.name.where,
               "there is another type or POU named " + quote(each.name.text));
  }
}

void TypeResolver::declare_all() {
  for (const syntax::TypeDeclaration& each : unit_.types) named(each.name);
}

const Type* TypeResolver::resolve(const syntax::TypeSpec& spec) {
  if (is_any_integer(spec)) return a_.type_table().elementary(ElementaryType::Lint);
  switch (spec.kind) {
    case syntax::TypeKind::Named:
      return named(spec.name);
    case syntax::TypeKind::Array:
      return array(spec);
    case syntax::TypeKind::Struct:
      return structure(spec, *a_.type_table().create(TypeKind::Struct, "STRUCT"));
    case syntax::TypeKind::Enumeration:
      return enumeration(spec, "enumeration");
    case syntax::TypeKind::Subrange:
      return subrange(spec);
    case syntax::TypeKind::Text:
      return text(spec);
    case syntax::TypeKind::Reference:
      return reference(spec);
    case syntax::TypeKind::Deduced:
    case syntax::TypeKind::Error:
      break;
  }
  return nullptr;
}

const Type* TypeResolver::resolve_parameter(const syntax::TypeSpec& spec) {
  const bool is_open = spec.kind == syntax::TypeKind::Array && !spec.ranges.front().low;
  return is_open ? open_array(spec) : resolve(spec);
}

std::vector<std::byte> TypeResolver::initial_of(const syntax::TypeSpec& spec, const Type& type) {
  if (spec.kind == syntax::TypeKind::Named) {
    const auto known = known_.find(spec.name.id.value);
    if (known != known_.end() && !known->second.initial.empty()) return known->second.initial;
  }
  std::vector<std::byte> bytes = type.initial;
  bytes.resize(type.size);
  if (spec.kind != syntax::TypeKind::Array || type.open) return bytes;
  const std::vector<std::byte> element = initial_of(*spec.element, *type.element);
  std::vector<std::byte> plain = type.element->initial;
  plain.resize(type.element->size);
  if (element == plain) return bytes;
  for (std::size_t at = 0; at + element.size() <= bytes.size() && !element.empty(); at += element.size())
    std::copy(element.begin(), element.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
  return bytes;
}

bool TypeResolver::names_block(const syntax::TypeSpec& spec) const {
  const syntax::TypeSpec* at = &spec;
  // Types that contain themselves are reported where they are made.
  for (std::size_t depth = 0; depth <= known_.size(); ++depth) {
    while (at->kind == syntax::TypeKind::Array && at->element) at = at->element.get();
    if (at->kind != syntax::TypeKind::Named) return false;
    const auto known = known_.find(at->name.id.value);
    if (known == known_.end()) {
      const auto pou = a_.pous.find(at->name.id.value);
      return pou != a_.pous.end() && pou->second->kind == PouKind::FunctionBlock;
    }
    at = known->second.declaration->type.get();
  }
  return false;
}

bool TypeResolver::is_any_integer(const syntax::TypeSpec& spec) const {
  return spec.kind == syntax::TypeKind::Named && a_.sink.sources().is_library(spec.name.where.file) &&
         a_.names.folded(spec.name.id) == "ANY_INT";
}

const Type* TypeResolver::named(const syntax::Name& name) {
  ElementaryType elementary{};
  const std::string& folded = a_.names.folded(name.id);
  if (elementary_from(folded, elementary)) return a_.type_table().elementary(elementary);
  if (folded == "STRING") return a_.type_table().string(ElementaryType::String, kDefaultStringCapacity);
  if (folded == "WSTRING") return a_.type_table().string(ElementaryType::Wstring, kDefaultStringCapacity);
  if (const auto known = known_.find(name.id.value); known != known_.end()) {
    if (known->second.state == State::Running) {
      a_.error(code::kRecursion, name.where, "the type " + quote(name.text) + " contains itself");
      return nullptr;
    }
    if (known->second.state == State::Open) {
      known->second.state = State::Running;
      if (!enter(name.where)) {
        known->second.state = State::Done;
        return a_.types[name.id.value] = nullptr;
      }
      // TYPE sees no POU's constants, whoever uses it first.
      Pou* const scope = std::exchange(scope_, nullptr);
      const Type* type = declared(known->second);
      scope_ = scope;
      --nesting_;
      known->second.state = State::Done;
      a_.types[name.id.value] = type;
    }
    return a_.types[name.id.value];
  }
  if (const auto pou = a_.pous.find(name.id.value); pou != a_.pous.end()) {
    // A test calls programs as if they were blocks.
    const bool in_test = scope_ != nullptr && scope_->test != nullptr;
    if (pou->second->kind != PouKind::FunctionBlock && !(in_test && pou->second->kind == PouKind::Program)) {
      a_.error(code::kUnknownType, name.where,
               quote(name.text) + " is no type but a " +
                   (pou->second->kind == PouKind::Program ? "program" : "function"));
      return nullptr;
    }
    if (layouts_[name.id.value] == State::Running) {
      a_.error(code::kRecursion, name.where, "the function block " + quote(name.text) + " contains itself");
      return nullptr;
    }
    if (layouts_[name.id.value] == State::Open) {
      if (!enter(name.where)) return nullptr;
      lay_out(*pou->second);
      --nesting_;
    }
    return is_shallow(*pou->second->type, name.where) ? pou->second->type : nullptr;
  }
  if (a_.sink.is_full()) {
    a_.error(code::kUnknownType, name.where, {});
    return nullptr;
  }
  std::vector<std::string> spellings;
  for (std::uint8_t i = 0; i < bytecode::kElementaryTypeCount; ++i)
    spellings.emplace_back(bytecode::name_of(static_cast<ElementaryType>(i)));
  for (const auto& each : unit_.types) spellings.emplace_back(each.name.text);
  for (const auto& each : a_.model.pous)
    if (each->kind == PouKind::FunctionBlock) spellings.push_back(each->spelling);
  // One declaration mends all uses, in whatever POU.
  a_.unknown_name(
      code::kUnknownType, nullptr, name.where, "there is no type " + quote(name.text),
      source::did_you_mean(name.text, std::vector<std::string_view>(spellings.begin(), spellings.end())));
  return nullptr;
}

bool TypeResolver::enter(Position where) {
  if (nesting_ >= kMaxTypeNesting) {
    a_.error(code::kTooDeep, where,
             "types are nested more than " + std::to_string(kMaxTypeNesting) + " levels deep",
             "hold more members in fewer levels");
    return false;
  }
  ++nesting_;
  return true;
}

bool TypeResolver::is_shallow(const Type& type, Position where) {
  if (type.nesting <= kMaxTypeNesting) return true;
  a_.error(code::kTooDeep, where,
           "types are nested more than " + std::to_string(kMaxTypeNesting) + " levels deep",
           "hold more members in fewer levels");
  return false;
}

bool TypeResolver::affords(std::size_t bytes, Position where) {
  // Every type keeps its own: many large types that nothing uses would need more than any machine has.
  constexpr std::size_t kMost = std::size_t{8} * kMaxData;
  if (bytes <= kMost - first_values_) {
    first_values_ += bytes;
    return true;
  }
  a_.error(code::kTooLarge, where, "the first values of all types together are larger than 256 MiB",
           "declare large arrays as variables, not as types");
  return false;
}

// A structure can be referred to while it is being made: TYPE Node : STRUCT next : REF_TO Node; ...
const Type* TypeResolver::declared(Known& known) {
  const syntax::TypeDeclaration& declaration = *known.declaration;
  const syntax::TypeSpec& spec = *declaration.type;
  std::string name(declaration.name.text);
  const Type* type = nullptr;
  if (spec.kind == syntax::TypeKind::Struct) {
    Type* made = a_.type_table().create(TypeKind::Struct, std::move(name));
    a_.types[declaration.name.id.value] = made;
    type = structure(spec, *made);
  } else if (spec.kind == syntax::TypeKind::Enumeration) {
    type = enumeration(spec, std::move(name));
  } else {
    type = resolve(spec);
  }
  if (type == nullptr || !affords(type->size, declaration.name.where)) return nullptr;
  known.initial = initial_of(spec, *type);
  if (!declaration.initial) return type;
  ExpressionAnalyzer expressions(a_, nullptr);
  return initialise(a_, expressions, *declaration.initial, *type, known.initial) ? type : nullptr;
}

}  // namespace stepwright::semantics::internal
