// Strings as instructions. A string on the stack is the Ref of its header; what an operation makes lies in a
// temporary of the frame, or at once in the variable that it is assigned to.

#include "ladder/codegen/expression_emitter.h"
#include "ladder/codegen/machine_type.h"

namespace stepwright::codegen {

using bytecode::ElementaryType;
using bytecode::Opcode;
using bytecode::StringOpId;
using semantics::Place;
using semantics::Type;
using semantics::Value;
using semantics::ValueKind;
using syntax::Operator;

namespace {

bool is_wide(const Type& type) {
  return type.elementary == ElementaryType::Wstring || type.elementary == ElementaryType::Wchar;
}

StringOpId for_width(StringOpId narrow, const Type& type) {
  return static_cast<StringOpId>(static_cast<std::uint8_t>(narrow) + (is_wide(type) ? 1 : 0));
}

bool sets_character(const Value& value) {
  return value.text_op == StringOpId::SetCharAtS || value.text_op == StringOpId::SetCharAtW;
}

// One instruction makes it, so that the target can be one of the operands.
bool is_simple(const Value& value) {
  const bool concat = value.text_op == StringOpId::ConcatS || value.text_op == StringOpId::ConcatW;
  return value.kind == ValueKind::Text && !sets_character(value) && !(concat && value.operands.size() > 2);
}

}  // namespace

// A free piece of the frame, used until the statement ends.
std::uint32_t ExpressionEmitter::temporary(std::uint32_t bytes) {
  for (Temporary& each : temporaries_) {
    if (each.in_use || each.bytes < bytes) continue;
    each.in_use = true;
    return each.offset;
  }
  const std::uint32_t offset = b_.allocate_frame(bytes, 2);
  temporaries_.push_back({offset, bytes, true});
  return offset;
}

void ExpressionEmitter::literal(const std::u16string& text, const Type& type) {
  b_.addr_abs(layout_.literals->address_of(text, type.elementary));
}

void ExpressionEmitter::text(const Value& value) {
  const Type& type = *value.type;
  if (!type.is_string()) {
    for (const auto& each : value.operands) this->value(*each);
    locate(value.where);
    b_.string_op(value.text_op);
    return narrow_number(value);
  }
  const std::uint32_t at = temporary(type.size);
  b_.addr_frame(at);
  b_.const_i32(static_cast<std::int32_t>(type.capacity));
  b_.string_op(for_width(StringOpId::InitS, type));
  b_.addr_frame(at);
  text_behind_target(value, at);
  b_.addr_frame(at);
}

// The target, which lies on the stack, becomes the result. `at`: the same target, if it is a temporary; what
// takes several instructions needs one.
void ExpressionEmitter::text_behind_target(const Value& value, std::uint32_t at) {
  const Type& type = *value.type;
  if (sets_character(value)) {
    literal(u" ", type);
    b_.string_op(for_width(StringOpId::CopyS, type));
    b_.addr_frame(at);
    b_.const_i32(1);
    this->value(*value.operands[0]);
    return b_.string_op(value.text_op);
  }
  if (is_simple(value)) {
    for (const auto& each : value.operands) this->value(*each);
    locate(value.where);
    return b_.string_op(value.text_op);
  }
  this->value(*value.operands[0]);
  this->value(*value.operands[1]);
  b_.string_op(value.text_op);
  for (std::size_t i = 2; i < value.operands.size(); ++i) {
    b_.addr_frame(at);
    b_.addr_frame(at);
    this->value(*value.operands[i]);
    b_.string_op(value.text_op);
  }
}

void ExpressionEmitter::assign_text(const Place& place, const Value& value) {
  reference(place);
  if (is_simple(value)) return text_behind_target(value, 0);
  this->value(value);
  b_.string_op(for_width(StringOpId::CopyS, *place.type));
}

// A number that was read from a text as 64 bits, in a narrower type.
void ExpressionEmitter::narrow_number(const Value& value) {
  const StringOpId op = value.text_op;
  const bool is_signed = op == StringOpId::ToI64S || op == StringOpId::ToI64W;
  const bool is_unsigned = op == StringOpId::ToU64S || op == StringOpId::ToU64W;
  if ((!is_signed && !is_unsigned) || value.type->size == 8) return;
  const semantics::IntegerRange range = semantics::range_of(value.type->elementary);
  const writer::LocalId number = local(bytecode::StackType::I64);
  b_.local_set(number);
  b_.local_get(number);
  b_.const_i64(static_cast<std::int64_t>(range.high));
  b_.emit(is_signed ? Opcode::LeI64 : Opcode::LeU64);
  if (is_signed) {
    b_.local_get(number);
    b_.const_i64(static_cast<std::int64_t>(range.low));
    b_.emit(Opcode::GeI64);
    b_.emit(Opcode::AndBool);
  }
  trap_unless(bytecode::TrapCode::ConversionRange);
  b_.local_get(number);
  b_.emit(Opcode::I64ToI32);
}

// Two strings on the stack become what their comparison says.
void ExpressionEmitter::compare_texts(Operator op, const Type& type) {
  b_.string_op(for_width(StringOpId::CompareS, type));
  b_.const_i32(0);
  b_.emit(binary_opcode(op, Machine::I32));
}

// MIN, MAX: the address of the string that it is.
void ExpressionEmitter::extreme_text(const Value& value, bool maximum) {
  const writer::LocalId best = local(bytecode::StackType::Ref);
  const writer::LocalId next = local(bytecode::StackType::Ref);
  this->value(*value.operands[0]);
  b_.local_set(best);
  for (std::size_t i = 1; i < value.operands.size(); ++i) {
    this->value(*value.operands[i]);
    b_.local_set(next);
    b_.local_get(best);
    b_.local_get(next);
    b_.local_get(next);
    b_.local_get(best);
    compare_texts(maximum ? Operator::Greater : Operator::Less, *value.operands[i]->type);
    b_.emit(Opcode::Select);
    b_.local_set(best);
  }
  b_.local_get(best);
}

// s[i], on a string that lies on the stack.
void ExpressionEmitter::load_character(const Place& place) {
  reference(place);
  value(*place.character);
  b_.string_op(for_width(StringOpId::CharAtS, *place.type));
}

bytecode::StringOpId ExpressionEmitter::set_character(const Type& type) {
  return for_width(StringOpId::SetCharAtS, type);
}

}  // namespace stepwright::codegen
