// First values of variables (IEC 61131-3, 6.5.1.3).

#include <algorithm>

#include "ladder/semantics/declarations/declarer.h"

namespace stepwright::semantics::internal {

namespace {

using syntax::Expression;
using syntax::ExpressionKind;

constexpr const char* kListHint = "lists are written [1, 2, 3(0)], structures (a := 1, b := 2)";

bool initialise_array(Analysis& a, ExpressionAnalyzer& expressions, const Expression& list, const Type& type,
                      std::span<std::byte> out) {
  const Type& element = *type.element;
  const std::size_t count = out.size() / element.size;
  std::size_t next = 0;
  bool sound = true;
  for (const auto& each : list.operands) {
    const bool repeats = each->kind == ExpressionKind::Repeat;
    const Expression* value = each.get();
    if (repeats) value = each->operands.size() > 1 ? each->operands[1].get() : nullptr;
    const std::uint64_t times = repeats ? each->operands[0]->integer : 1;
    if (times > count - next) {
      a.error(code::kBadInitializer, each->where,
              "more values than the " + std::to_string(count) + " elements of the array");
      return false;
    }
    if (value != nullptr && times > 1 && element.is_scalar()) {
      const auto constant = expressions.constant(*value, &element);
      if (!constant) return false;
      for (std::uint64_t i = 0; i < times; ++i, ++next)
        store(*constant, element, out.subspan(next * element.size, element.size));
      continue;
    }
    for (std::uint64_t i = 0; i < times && sound; ++i, ++next)
      if (value != nullptr)
        sound = initialise(a, expressions, *value, element, out.subspan(next * element.size, element.size));
  }
  return sound;
}

bool initialise_struct(Analysis& a, ExpressionAnalyzer& expressions, const Expression& list, const Type& type,
                       std::span<std::byte> out) {
  bool sound = true;
  for (const syntax::Argument& each : list.arguments) {
    const Type* member = nullptr;
    std::uint32_t offset = 0;
    std::uint8_t bit = bytecode::kNoBit;
    if (type.kind == TypeKind::Struct) {
      if (const Field* field = type.find_field(each.formal->id)) {
        member = field->type;
        offset = field->offset;
        bit = field->bit;
      }
    } else if (const Variable* found = type.pou->find(each.formal->id);
               found != nullptr && found->place.base == Base::This) {
      member = found->type;
      offset = found->place.offset;
      if (member == nullptr) return false;
    }
    if (member == nullptr) {
      a.error(code::kUnknownMember, each.formal->where,
              quote(type.name) + " has no member " + quote(each.formal->text));
      sound = false;
      continue;
    }
    std::byte alone{0};
    const bool is_bit = bit != bytecode::kNoBit;
    const auto at = is_bit ? std::span(&alone, 1) : out.subspan(offset, member->size);
    sound = initialise(a, expressions, *each.value, *member, at) && sound;
    if (is_bit) set_bit(out[offset], bit, alone);
  }
  return sound;
}

// A first value is written down in full, so one that is too long is a mistake and is not cut.
bool initialise_text(Analysis& a, ExpressionAnalyzer& expressions, const Expression& initial,
                     const Type& type, std::span<std::byte> out) {
  const Type* longest = a.type_table().string(type.elementary, bytecode::kMaxStringCapacity);
  const auto value = expressions.constant(initial, longest);
  if (!value) return false;
  if (value->text.size() > type.capacity) {
    a.error(code::kOutOfRange, initial.where,
            "the text has " + std::to_string(value->text.size()) + " characters, " + type.name + " holds " +
                std::to_string(type.capacity));
    return false;
  }
  store(*value, type, out);
  return true;
}

// REF(x) of what has an address before the program runs.
bool initialise_reference(Analysis& a, ExpressionAnalyzer& expressions, const Expression& initial,
                          const Type& type, std::span<std::byte> out) {
  const ValuePtr value = expressions.value_as(initial, &type);
  if (!value) return false;
  if (value->kind == ValueKind::Constant) {
    store(value->constant, type, out);
    return true;
  }
  if (value->kind != ValueKind::Reference || !value->place.is_direct()) {
    a.error(code::kNotConstant, initial.where, "the reference must be known when the program is compiled",
            "use REF of a variable that is declared before, or NULL");
    return false;
  }
  store(a.add_first_target(value->place, expressions.pou()), type, out);
  return true;
}

}  // namespace

bool initialise(Analysis& a, ExpressionAnalyzer& expressions, const Expression& initial, const Type& type,
                std::span<std::byte> out) {
  if (type.is_reference()) return initialise_reference(a, expressions, initial, type, out);
  if (type.is_scalar()) {
    const auto value = expressions.constant(initial, &type);
    if (value) store(*value, type, out);
    return value.has_value();
  }
  if (type.is_string()) return initialise_text(a, expressions, initial, type, out);
  if (type.kind == TypeKind::Array && initial.kind == ExpressionKind::ArrayValues)
    return initialise_array(a, expressions, initial, type, out);
  if (type.kind != TypeKind::Array && initial.kind == ExpressionKind::StructValues)
    return initialise_struct(a, expressions, initial, type, out);
  if (initial.kind != ExpressionKind::Error)
    a.error(code::kBadInitializer, initial.where, "this is no first value for " + type.name, kListHint);
  return false;
}

}  // namespace stepwright::semantics::internal
