// Errors of standard functions whose ENO is connected (IEC 61131-3, 6.6.1.5): ENO becomes FALSE, the function
// is not run, and the scan goes on. The operands are computed first, once, into slots; what they must hold is
// tested there (value_condition.cpp).

#include "ladder/semantics/calls/error_guard.h"

#include <algorithm>
#include <utility>

#include "ladder/semantics/calls/error_test.h"
#include "ladder/semantics/calls/value_condition.h"

namespace stepwright::semantics::internal {

using bytecode::StringOpId;
using syntax::Operator;

namespace {

bool may_be_negative(const Value& value) {
  if (value.kind == ValueKind::Constant) return value.constant.integer < 0;
  if (value.kind == ValueKind::Convert) return may_be_negative(*value.operands.front());
  return !value.type->is_unsigned();
}

// LEFT, RIGHT, MID, INSERT, DELETE, REPLACE.
bool counts_characters(StringOpId op) {
  return op >= StringOpId::LeftS && op <= StringOpId::ReplaceW;
}

// STRING_TO_INT and its like.
bool reads_literal(StringOpId op) {
  return op >= StringOpId::ToBoolS && !bytecode::is_test(op) &&
         bytecode::tested_by(bytecode::test_of(op)) == op;
}

ErrorTest text_test(const Value& called) {
  if (called.text_op == StringOpId::CharAtS || called.text_op == StringOpId::CharAtW)
    return ErrorTest::FirstCharacter;
  if (reads_literal(called.text_op)) return ErrorTest::Literal;
  if (!counts_characters(called.text_op)) return ErrorTest::None;
  const bool counts = std::ranges::any_of(called.operands, [](const ValuePtr& each) {
    return each->type->is_integer() && may_be_negative(*each);
  });
  return counts ? ErrorTest::Counts : ErrorTest::None;
}

ErrorTest function_test(StandardFunction function) {
  using enum StandardFunction;
  switch (function) {
    case Sqrt:
    case Ln:
    case Log:
    case Asin:
    case Acos:
      return ErrorTest::Domain;
    case Power:
      return ErrorTest::Power;
    case FromBcd:
      return ErrorTest::Code;
    case ToBcd:
      return ErrorTest::Digits;
    default:
      return ErrorTest::None;
  }
}

Constant first_value(const Type& scalar) {
  std::vector<std::byte> first = scalar.initial;
  first.resize(scalar.size);
  return semantics::load(scalar, first);
}

}  // namespace

ErrorTest error_test(const Value& called) {
  switch (called.kind) {
    case ValueKind::Binary:
      return (called.op == Operator::Divide || called.op == Operator::Modulo) && called.operands.size() == 2
                 ? ErrorTest::Divisor
                 : ErrorTest::None;
    case ValueKind::Convert:
    case ValueKind::Truncate:
      if (!called.operands[0]->type->is_real()) return ErrorTest::None;
      if (called.type->is_integer()) return ErrorTest::Range;
      if (called.type->is_real())
        return called.type->size < called.operands[0]->type->size ? ErrorTest::Single : ErrorTest::None;
      return called.type->is_time() || called.type->is_date() ? ErrorTest::Duration : ErrorTest::None;
    case ValueKind::Multiplex:
      return ErrorTest::Choice;
    case ValueKind::Shift:
      return may_be_negative(*called.operands[1]) ? ErrorTest::Places : ErrorTest::None;
    case ValueKind::Standard:
      return function_test(called.function);
    case ValueKind::Text:
      return text_test(called);
    case ValueKind::Call:
      return ErrorTest::Arguments;
    default:
      return ErrorTest::None;
  }
}

// Operands are computed in their order, so those before a tested one are kept, too.
bool is_kept_aside(ErrorTest test, const Value& called, std::size_t operand) {
  if (called.operands[operand]->kind == ValueKind::Constant) return false;
  switch (test) {
    case ErrorTest::Divisor:
    case ErrorTest::Places:
    case ErrorTest::Power:
    case ErrorTest::Counts:
    case ErrorTest::Arguments:
      return true;
    default:
      return operand == 0;
  }
}

// A value that can be read again, in a slot; of a text the address.
ValuePtr ErrorGuard::kept_aside(ValuePtr value, std::vector<CopyBefore>& before) {
  const Position where = value->where;
  const Type* type = value->type;
  const bool is_text = type->is_string();
  Place slot;
  slot.base = Base::Slot;
  slot.type = is_text ? a_.type_table().reference(type) : type;
  pou_.slots.push_back(slot_type(*slot.type));
  slot.slot = static_cast<std::uint32_t>(pou_.slots.size() - 1);
  before.push_back({copy_direct(slot), std::move(value)});
  if (is_text) {
    slot.base = Base::SlotRef;
    slot.type = type;
  }
  return load(std::move(slot), where);
}

// Where the function is made of two parts, each may fail: `enabled` says so of both.
ValuePtr ErrorGuard::unless_error(ValuePtr called, const Place& enabled) {
  const bool in_parts = called->kind == ValueKind::Convert && called->converts_part;
  if (in_parts) called->operands[0] = unless_error(std::move(called->operands[0]), enabled);
  if (in_parts && !called->operands[0]) return nullptr;
  const ErrorTest test = error_test(*called);
  ValueCondition condition(a_, e_, pou_);
  if (test == ErrorTest::Arguments && condition.condition_of(*called->pou) == nullptr) return called;
  if (test == ErrorTest::None) return called;
  ValuePtr result = make(ValueKind::Enabled, called->type, called->where);
  for (std::size_t i = 0; i < called->operands.size(); ++i) {
    ValuePtr& operand = called->operands[i];
    if (is_kept_aside(test, *called, i)) operand = kept_aside(std::move(operand), result->before);
  }
  ValuePtr good = condition.has_value(*called, test);
  if (good && in_parts)
    good = e_.operators().combine(Operator::And, load(copy_direct(enabled), called->where), std::move(good),
                                  called->where);
  if (!good) return nullptr;
  result->before.push_back({copy_direct(enabled), std::move(good)});
  result->operands.push_back(load(copy_direct(enabled), called->where));
  add_or_first(*result, std::move(called));
  return result;
}

void ErrorGuard::add_or_first(Value& enabled, ValuePtr called) {
  const Type* type = called->type;
  const Position where = called->where;
  enabled.operands.push_back(std::move(called));
  if (type->kind == TypeKind::Nothing) return;
  if (type->is_scalar()) {
    enabled.constant = first_value(*type);
  } else {
    enabled.place = frame_place(pou_, type);
    enabled.operands.push_back(load(a_.allocate_place(type, where), where));
  }
}

}  // namespace stepwright::semantics::internal
