#include "ladder/semantics/types/type.h"

#include <array>

#include "ladder/semantics/types/constant.h"

namespace stepwright::semantics {

namespace {

using enum ElementaryType;

bool between(ElementaryType type, ElementaryType first, ElementaryType last) {
  return type >= first && type <= last;
}

// Value bits without the sign.
unsigned magnitude_bits(ElementaryType type) {
  switch (type) {
    case Sint:
      return 7;
    case Int:
      return 15;
    case Dint:
      return 31;
    case Lint:
    case Time:
    case Date:
    case Tod:
    case Dt:
      return 63;
    case Usint:
    case Byte:
    case Char:
      return 8;
    case Uint:
    case Word:
    case Wchar:
      return 16;
    case Udint:
    case Dword:
      return 32;
    case Ulint:
    case Lword:
      return 64;
    default:
      return 1;
  }
}

}  // namespace

bool Type::is_scalar() const {
  switch (kind) {
    case TypeKind::Nothing:
    case TypeKind::Array:
    case TypeKind::Struct:
    case TypeKind::String:
    case TypeKind::Instance:
      return false;
    default:
      return true;
  }
}

bool Type::is_integer() const {
  return kind == TypeKind::AnyInteger || kind == TypeKind::Subrange ||
         (kind == TypeKind::Elementary && between(elementary, Sint, Ulint));
}

bool Type::is_unsigned() const {
  const bool is_number =
      kind == TypeKind::Elementary || kind == TypeKind::Enumeration || kind == TypeKind::Subrange;
  return is_number && bytecode::is_unsigned(elementary);
}

bool Type::is_date() const {
  return is(Date) || is(Tod) || is(Dt);
}

bool Type::is_real() const {
  return kind == TypeKind::AnyReal || is(Real) || is(Lreal);
}

bool Type::is_bits() const {
  return kind == TypeKind::Elementary && between(elementary, Byte, Lword);
}

TypeTable::TypeTable() {
  for (std::uint8_t i = 0; i < bytecode::kScalarTypeCount; ++i) {
    const auto which = static_cast<ElementaryType>(i);
    Type* type = create(TypeKind::Elementary, bytecode::name_of(which));
    type->elementary = which;
    type->size = bytecode::size_of(bytecode::mem_type(which));
    elementary_.push_back(type);
  }
  any_integer_ = create(TypeKind::AnyInteger, "an integer literal");
  any_real_ = create(TypeKind::AnyReal, "a real literal");
  any_enumerator_ = create(TypeKind::AnyEnumerator, "the value of an enumeration");
  null_ = create(TypeKind::Null, "NULL");
  nothing_ = create(TypeKind::Nothing, "no value");
}

Type* TypeTable::create(TypeKind kind, std::string name) {
  auto type = std::make_unique<Type>();
  type->kind = kind;
  type->name = std::move(name);
  types_.push_back(std::move(type));
  return types_.back().get();
}

const Type* TypeTable::array(const Type* element, std::vector<Dimension> dimensions) {
  std::string name = "ARRAY[";
  std::uint32_t count = 1;
  for (std::size_t i = 0; i < dimensions.size(); ++i) {
    name +=
        (i > 0 ? "," : "") + std::to_string(dimensions[i].lower) + ".." + std::to_string(dimensions[i].upper);
    count *= dimensions[i].count();
  }
  name += "] OF " + element->name;
  const Type*& known = shapes_[name];
  if (known != nullptr && known->element == element) return known;
  Type* type = create(TypeKind::Array, name);
  type->element = element;
  type->dimensions = std::move(dimensions);
  type->size = element->size * count;
  type->nesting = element->nesting + static_cast<std::uint32_t>(type->dimensions.size());
  if (!element->initial.empty()) {
    type->initial.reserve(type->size);
    for (std::uint32_t i = 0; i < count; ++i)
      type->initial.insert(type->initial.end(), element->initial.begin(), element->initial.end());
  }
  known = type;
  return type;
}

const Type* TypeTable::open_array(const Type* element, std::size_t dimensions) {
  std::string name = "ARRAY[*";
  for (std::size_t i = 1; i < dimensions; ++i) name += ",*";
  name += "] OF " + element->name;
  const Type*& known = shapes_[name];
  if (known != nullptr && known->element == element) return known;
  Type* type = create(TypeKind::Array, name);
  type->element = element;
  type->dimensions.resize(dimensions);
  type->open = true;
  type->size = 0;
  type->nesting = element->nesting + static_cast<std::uint32_t>(type->dimensions.size());
  known = type;
  return type;
}

const Type* TypeTable::subrange(const Type* base, IntegerRange range) {
  std::string name = base->name + "(" + to_string(range.low) + ".." + to_string(range.high) + ")";
  const Type*& known = shapes_[name];
  if (known != nullptr) return known;
  Type* type = create(TypeKind::Subrange, name);
  type->elementary = base->elementary;
  type->base = base;
  type->size = base->size;
  type->range = range;
  // A variable starts with the lowest value.
  type->initial.resize(type->size);
  store({range.low}, *type, type->initial);
  known = type;
  return type;
}

const Type* TypeTable::reference(const Type* target) {
  const Type*& known = references_[target];
  if (known != nullptr) return known;
  Type* type = create(TypeKind::Reference, "REF_TO " + target->name);
  type->element = target;
  type->size = bytecode::size_of(bytecode::MemType::Ref);
  type->initial.resize(type->size);
  store({bytecode::kNullRef}, *type, type->initial);
  known = type;
  return type;
}

const Type* TypeTable::string(ElementaryType which, std::uint32_t capacity) {
  std::string name = std::string(bytecode::name_of(which)) + "[" + std::to_string(capacity) + "]";
  const Type*& known = shapes_[name];
  if (known != nullptr) return known;
  Type* type = create(TypeKind::String, name);
  type->elementary = which;
  type->capacity = capacity;
  type->size = bytecode::string_bytes(which, capacity);
  type->initial.resize(type->size);
  type->initial[0] = static_cast<std::byte>(capacity & 0xFF);
  type->initial[1] = static_cast<std::byte>(capacity >> 8);
  known = type;
  return type;
}

bytecode::MemType mem_type(const Type& type) {
  return type.is_reference() ? bytecode::MemType::Ref : bytecode::mem_type(type.elementary);
}

bytecode::StackType slot_type(const Type& type) {
  return bytecode::stack_type(mem_type(type));
}

bool elementary_from(const std::string& folded, ElementaryType& out) {
  struct Synonym {
    const char* name;
    ElementaryType type;
  };
  static constexpr Synonym kSynonyms[] = {{"LTIME", Time},        {"LDATE", Date},       {"TIME_OF_DAY", Tod},
                                          {"LTOD", Tod},          {"LTIME_OF_DAY", Tod}, {"LDT", Dt},
                                          {"LDATE_AND_TIME", Dt}, {"DATE_AND_TIME", Dt}};
  for (const Synonym& each : kSynonyms) {
    if (folded != each.name) continue;
    out = each.type;
    return true;
  }
  for (std::uint8_t i = 0; i < bytecode::kScalarTypeCount; ++i) {
    out = static_cast<ElementaryType>(i);
    if (folded == bytecode::name_of(out)) return true;
  }
  return false;
}

bool widens(const Type& from, const Type& to) {
  if (&from == &to) return true;
  if (from.kind != TypeKind::Elementary || to.kind != TypeKind::Elementary) return false;
  if (from.is_integer() && to.is_integer()) {
    if (!from.is_unsigned() && to.is_unsigned()) return false;
    return magnitude_bits(from.elementary) <= magnitude_bits(to.elementary);
  }
  if (from.is_integer() && to.is_real()) return magnitude_bits(from.elementary) <= (to.is(Real) ? 16u : 32u);
  if (from.is_real() && to.is_real()) return to.is(Lreal);
  if ((from.is_bool() || from.is_bits()) && to.is_bits()) return from.bit_count() <= to.bit_count();
  return false;
}

IntegerRange range_of(ElementaryType type) {
  const __int128 limit = static_cast<__int128>(1) << magnitude_bits(type);
  const bool is_signed = between(type, Sint, Lint) || between(type, Time, Dt);
  return {is_signed ? -limit : 0, limit - 1};
}

}  // namespace stepwright::semantics
