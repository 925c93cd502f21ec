#include "ladder/semantics/type.h"

#include <array>

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
      return 63;
    case Usint:
    case Byte:
      return 8;
    case Uint:
    case Word:
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
  return kind != TypeKind::Array && kind != TypeKind::Struct && kind != TypeKind::Instance;
}

bool Type::is_integer() const {
  return kind == TypeKind::AnyInteger || (kind == TypeKind::Elementary && between(elementary, Sint, Ulint));
}

bool Type::is_unsigned() const {
  return kind == TypeKind::Elementary && bytecode::is_unsigned(elementary);
}

bool Type::is_real() const {
  return kind == TypeKind::AnyReal || is(Real) || is(Lreal);
}

bool Type::is_bits() const {
  return kind == TypeKind::Elementary && between(elementary, Byte, Lword);
}

TypeTable::TypeTable() {
  for (std::uint8_t i = 0; i < bytecode::kElementaryTypeCount; ++i) {
    const auto which = static_cast<ElementaryType>(i);
    Type* type = create(TypeKind::Elementary, bytecode::name_of(which));
    type->elementary = which;
    type->size = bytecode::size_of(bytecode::mem_type(which));
    elementary_.push_back(type);
  }
  any_integer_ = create(TypeKind::AnyInteger, "an integer literal");
  any_real_ = create(TypeKind::AnyReal, "a real literal");
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
  const Type*& known = arrays_[name];
  if (known != nullptr && known->element == element) return known;
  Type* type = create(TypeKind::Array, name);
  type->element = element;
  type->dimensions = std::move(dimensions);
  type->size = element->size * count;
  if (!element->initial.empty()) {
    type->initial.reserve(type->size);
    for (std::uint32_t i = 0; i < count; ++i)
      type->initial.insert(type->initial.end(), element->initial.begin(), element->initial.end());
  }
  known = type;
  return type;
}

bool elementary_from(const std::string& folded, ElementaryType& out) {
  if (folded == "LTIME") {
    out = Time;
    return true;
  }
  for (std::uint8_t i = 0; i < bytecode::kElementaryTypeCount; ++i) {
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
  const bool is_signed = between(type, Sint, Lint);
  return {is_signed ? -limit : 0, limit - 1};
}

}  // namespace stepwright::semantics
