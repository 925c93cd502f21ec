// Elements of arrays (IEC 61131-3, 6.4.4.5 and 6.5.3).

#include <algorithm>
#include <limits>
#include <utility>

#include "ladder/semantics/conversions/text.h"
#include "ladder/semantics/expressions/places.h"

namespace stepwright::semantics::internal {

using syntax::Expression;

std::optional<Place> Places::index_place(const Expression& expression) {
  std::optional<Place> base = part(*expression.operands[0]);
  if (base && base->type->is_string()) return character_place(std::move(*base), expression);
  bool sound = base.has_value();
  const std::size_t given = expression.operands.size() - 1;
  if (sound && base->type->kind != TypeKind::Array) {
    a_.error(code::kTypeMismatch, expression.where, base->type->name + " is no array and cannot be indexed");
    sound = false;
  }
  if (sound && given != base->type->dimensions.size()) {
    a_.error(code::kIndexCount, expression.where,
             "the array has " + std::to_string(base->type->dimensions.size()) + " dimensions, found " +
                 std::to_string(given) + " indexes");
    sound = false;
  }
  if (!sound) return std::nullopt;
  const Type& array = *base->type;
  if (array.open) return open_index(std::move(*base), expression);
  std::uint32_t stride = array.size;
  for (std::size_t i = 0; i < given; ++i) {
    const Dimension& dimension = array.dimensions[i];
    stride /= dimension.count();
    if (!add_index(*base, *expression.operands[i + 1], dimension, stride)) return std::nullopt;
  }
  base->type = array.element;
  return base;
}

ValuePtr Places::index_value(const Expression& index) {
  ValuePtr value = c_.bits().counted(c_.settle(values_.value(index)));
  if (!value || value->type->is_integer()) return value;
  a_.error(code::kTypeMismatch, index.where, "an index must be an integer, not " + value->type->name,
           c_.bits().bits_hint(*value->type));
  return nullptr;
}

// Any integer is an index (6.4.4.5), the machine has DINT: what is larger is first brought next to the
// bounds, where it stays outside of them.
ValuePtr Places::narrow_index(ValuePtr value, const Dimension& bounds) {
  const Type* dint = a_.type_table().elementary(ElementaryType::Dint);
  const Position where = value->where;
  const auto converted = [&](ValuePtr from, const Type* to) {
    if (from->type == to) return from;
    ValuePtr result = make(ValueKind::Convert, to, where);
    result->operands.push_back(std::move(from));
    return result;
  };
  if (value->type->kind == TypeKind::Subrange) value->type = value->type->base;
  if (value->type == dint || widens(*value->type, *dint)) return converted(std::move(value), dint);
  const bool is_unsigned = value->type->size == 8 && value->type->is_unsigned();
  const Type* wide = a_.type_table().elementary(is_unsigned ? ElementaryType::Ulint : ElementaryType::Lint);
  value = converted(std::move(value), wide);
  const auto bounded = [&](StandardFunction function, std::int64_t bound) {
    ValuePtr result = make(ValueKind::Standard, wide, where);
    result->function = function;
    result->operands.push_back(std::move(value));
    result->operands.push_back(make_constant({bound}, wide, where));
    value = std::move(result);
  };
  const std::int64_t above = std::int64_t{bounds.upper} + 1;
  bounded(StandardFunction::Min, is_unsigned ? std::max<std::int64_t>(above, 0) : above);
  if (!is_unsigned) bounded(StandardFunction::Max, std::int64_t{bounds.lower} - 1);
  return converted(std::move(value), dint);
}

bool Places::add_index(Place& place, const Expression& index, const Dimension& dimension,
                       std::uint32_t stride) {
  ValuePtr value = index_value(index);
  if (!value) return false;
  if (value->kind != ValueKind::Constant) {
    value = narrow_index(std::move(value), dimension);
    PlaceStep step;
    step.index = std::move(value);
    step.lower = dimension.lower;
    step.upper = dimension.upper;
    step.stride = stride;
    place.steps.push_back(std::move(step));
    return true;
  }
  const __int128 number = value->constant.integer;
  if (number < dimension.lower || number > dimension.upper) {
    a_.error(code::kConstantIndex, index.where, "the index " + to_string(number) + " is outside of the array",
             "it goes from " + std::to_string(dimension.lower) + " to " + std::to_string(dimension.upper));
    return false;
  }
  advance(place, static_cast<std::uint32_t>(number - dimension.lower) * stride);
  return true;
}

// An element of a variable-length array: the bounds are known when the program runs.
std::optional<Place> Places::open_index(Place base, const Expression& expression) {
  PlaceStep step;
  step.stride = base.type->element->size;
  for (std::size_t i = 1; i < expression.operands.size(); ++i) {
    OpenIndex each;
    ValuePtr index = index_value(*expression.operands[i]);
    if (!index) return std::nullopt;
    constexpr Dimension kAll{std::numeric_limits<std::int32_t>::min() + 1,
                             std::numeric_limits<std::int32_t>::max() - 1};
    each.index = narrow_index(std::move(index), kAll);
    const auto bound = [&](std::size_t which) {
      return load(copy_direct(base.open->bounds[2 * (i - 1) + which]), expression.where);
    };
    each.lower = bound(0);
    each.upper = bound(1);
    step.open.push_back(std::move(each));
  }
  base.steps.push_back(std::move(step));
  base.type = base.type->element;
  base.open = nullptr;
  return base;
}

// s[i]
std::optional<Place> Places::character_place(Place text, const Expression& expression) {
  if (expression.operands.size() != 2) {
    a_.error(code::kIndexCount, expression.where, "a string has one index, the position of a character");
    return std::nullopt;
  }
  const Expression& index = *expression.operands[1];
  ValuePtr position = index_value(index);
  if (!position) return std::nullopt;
  const bool of_any_length = text.base == Base::ThisRef || text.base == Base::SlotRef;
  const std::uint32_t most = of_any_length ? bytecode::kMaxStringCapacity : text.type->capacity;
  const __int128 number = position->constant.integer;
  const bool constant = position->kind == ValueKind::Constant;
  if (constant && (number < 1 || number > static_cast<__int128>(most))) {
    a_.error(code::kConstantIndex, index.where, "the string has no character " + to_string(number),
             "positions go from 1 to " + std::to_string(most));
    return std::nullopt;
  }
  const Dimension bounds{1, static_cast<std::int32_t>(most)};
  text.character =
      constant ? make_constant({number}, a_.type_table().elementary(ElementaryType::Dint), position->where)
               : narrow_index(std::move(position), bounds);
  text.type = a_.type_table().elementary(
      width_of(*text.type) == ElementaryType::Wstring ? ElementaryType::Wchar : ElementaryType::Char);
  return text;
}

}  // namespace stepwright::semantics::internal
