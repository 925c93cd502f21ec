// FOR. Whether the loop goes on is asked before the step is added, so that no wrap at the end of a type can
// fool the answer; and a variable of a subrange type never takes a value outside of its range.

#include "ladder/codegen/function_emitter.h"
#include "ladder/codegen/machine_type.h"

namespace stepwright::codegen {

using bytecode::Opcode;
using semantics::Statement;
using semantics::Type;
using semantics::TypeKind;
using semantics::ValueKind;
using syntax::Operator;
using writer::Label;
using writer::LocalId;

namespace {

bool is_constant(const semantics::ValuePtr& value) {
  return value->kind == ValueKind::Constant;
}

// A variable of a subrange type that has not passed this limit is in its range.
bool limit_is_in_range(const Statement& statement) {
  const semantics::IntegerRange& range = statement.target.type->range;
  const semantics::Constant& limit = statement.limit->constant;
  return is_constant(statement.limit) && limit.integer >= range.low && limit.integer <= range.high;
}

}  // namespace

// The limit and the step are evaluated once (7.3.3.4.2). Behind the loop the variable holds the first value
// that was out of range, wrapped to its type; one of a subrange type that cannot hold it keeps the last one.
void FunctionEmitter::count(const Statement& statement) {
  e_.assign(statement.target, *statement.value);
  const __int128 step = is_constant(statement.step) ? statement.step->constant.integer : 0;
  if (step == 1 || step == -1 || (step != 0 && is_constant(statement.limit)))
    return count_by_constant(statement);
  count_by_value(statement);
}

void FunctionEmitter::count_by_constant(const Statement& statement) {
  const Type& type = *statement.target.type;
  const bool upwards = statement.step->constant.integer > 0;
  Loop loop{b_.new_label(), b_.new_label()};
  Counter counter;
  if (!is_constant(statement.limit)) {
    counter.limit = e_.held_local(semantics::slot_type(type));
    e_.value(*statement.limit);
    b_.local_set(counter.limit);
    loop.kept.emplace_back(statement.limit.get(), counter.limit);
  }
  const Label start = b_.new_label();
  e_.load(statement.target);
  if (is_constant(statement.limit)) {
    e_.constant(statement.limit->constant, type);
  } else {
    b_.local_get(counter.limit);
  }
  e_.operation(upwards ? Operator::LessEqual : Operator::GreaterEqual, type);
  b_.jump_if_false(loop.exit);
  b_.bind(start);
  body(statement, loop);
  b_.bind(loop.next);
  e_.line(statement.where);
  push_last(statement, counter.limit);
  step_on(statement, counter, {start, loop.exit, true});
  b_.bind(loop.exit);
  release(loop, type);
}

void FunctionEmitter::release(const Loop& loop, const Type& type) {
  for (const auto& [value, local] : loop.kept) e_.release(local, semantics::slot_type(type));
}

void FunctionEmitter::push_last(const Statement& statement, LocalId limit) {
  const Type& type = *statement.target.type;
  const __int128 step = statement.step->constant.integer;
  if (!is_constant(statement.limit)) {
    // Step 1 or -1: the last value is the limit itself.
    e_.load(statement.target);
    b_.local_get(limit);
    return e_.operation(step > 0 ? Operator::GreaterEqual : Operator::LessEqual, type);
  }
  const semantics::Constant last{statement.limit->constant.integer - step};
  if (!semantics::fits(last, type)) return b_.const_bool(true);
  e_.load(statement.target);
  e_.constant(last, type);
  e_.operation(step > 0 ? Operator::Greater : Operator::Less, type);
}

// The limit is a variable, or the step, whose sign then decides at run time.
void FunctionEmitter::count_by_value(const Statement& statement) {
  const Type& type = *statement.target.type;
  Loop loop{b_.new_label(), b_.new_label()};
  Counter counter;
  const auto keep = [&](const semantics::ValuePtr& value) {
    const LocalId local = e_.held_local(semantics::slot_type(type));
    e_.value(*value);
    b_.local_set(local);
    loop.kept.emplace_back(value.get(), local);
    return local;
  };
  counter.limit = keep(statement.limit);
  if (!is_constant(statement.step)) counter.step = keep(statement.step);
  push_within(statement, counter, false);
  b_.jump_if_false(loop.exit);
  const Label start = b_.new_label();
  b_.bind(start);
  body(statement, loop);
  b_.bind(loop.next);
  e_.line(statement.where);
  push_within(statement, counter, true);
  step_on(statement, counter, {start, loop.exit, false});
  b_.bind(loop.exit);
  release(loop, type);
}

void FunctionEmitter::push_within(const Statement& statement, const Counter& counter, bool next) {
  const Type& type = *statement.target.type;
  if (is_constant(statement.step) || type.is_unsigned()) {
    const bool upwards = type.is_unsigned() || statement.step->constant.integer > 0;
    return push_within(statement, counter, next, upwards);
  }
  push_within(statement, counter, next, false);
  push_within(statement, counter, next, true);
  push_step(statement, counter);
  e_.constant({}, type);
  e_.operation(Operator::GreaterEqual, type);
  b_.emit(Opcode::Select);
}

void FunctionEmitter::push_within(const Statement& statement, const Counter& counter, bool next,
                                  bool upwards) {
  const Type& type = *statement.target.type;
  const Operator order = upwards ? Operator::LessEqual : Operator::GreaterEqual;
  if (type.size == 8) {
    e_.load(statement.target);
    b_.local_get(counter.limit);
    e_.operation(order, type);
    if (next) push_step_fits(statement, counter, upwards);
    return;
  }
  // In 64 bits the next value cannot wrap.
  const auto widen = [&] { b_.emit(type.is_unsigned() ? Opcode::U32ToI64 : Opcode::I32ToI64); };
  e_.load(statement.target);
  widen();
  if (next) {
    push_step(statement, counter);
    widen();
    b_.emit(Opcode::AddI64);
  }
  b_.local_get(counter.limit);
  widen();
  b_.emit(binary_opcode(order, Machine::I64));
}

// Joins to the answer on the stack, that the variable is within the limit, whether the way from there to the
// limit is a step long: of two numbers in order the difference is exact as an unsigned one.
void FunctionEmitter::push_step_fits(const Statement& statement, const Counter& counter, bool upwards) {
  if (upwards) b_.local_get(counter.limit);
  e_.load(statement.target);
  if (!upwards) {
    b_.local_get(counter.limit);
    b_.emit(Opcode::SubI64);
    b_.const_i64(0);
  } else {
    b_.emit(Opcode::SubI64);
  }
  push_step(statement, counter);
  if (!upwards) b_.emit(Opcode::SubI64);
  b_.emit(binary_opcode(Operator::GreaterEqual, Machine::U64));
  b_.emit(Opcode::AndBool);
}

void FunctionEmitter::push_step(const Statement& statement, const Counter& counter) {
  if (is_constant(statement.step)) return e_.constant(statement.step->constant, *statement.target.type);
  b_.local_get(counter.step);
}

void FunctionEmitter::push_next(const Statement& statement, const Counter& counter) {
  e_.load(statement.target);
  push_step(statement, counter);
  e_.operation(Operator::Add, *statement.target.type);
}

void FunctionEmitter::step_on(const Statement& statement, const Counter& counter, const Turn& turn) {
  const Type& type = *statement.target.type;
  if (type.kind != TypeKind::Subrange) {
    e_.store(statement.target, [&](Width width) {
      push_next(statement, counter);
      if (width == Width::Exact) e_.wrap(type);
    });
    return turn.ends ? b_.jump_if_false(turn.start) : b_.jump_if_true(turn.start);
  }
  const Label over = b_.new_label();
  turn.ends ? b_.jump_if_true(over) : b_.jump_if_false(over);
  e_.store(statement.target, [&](Width) {
    push_next(statement, counter);
    if (!limit_is_in_range(statement)) e_.check_range(type);
  });
  b_.jump(turn.start);
  b_.bind(over);
  leave_in_range(statement, counter, turn.exit);
}

void FunctionEmitter::leave_in_range(const Statement& statement, const Counter& counter, Label exit) {
  const Type& type = *statement.target.type;
  const LocalId next = e_.local(semantics::slot_type(type));
  push_next(statement, counter);
  e_.wrap(type);
  b_.local_set(next);
  b_.local_get(next);
  e_.constant({type.range.low}, type);
  e_.operation(Operator::GreaterEqual, type);
  b_.local_get(next);
  e_.constant({type.range.high}, type);
  e_.operation(Operator::LessEqual, type);
  b_.emit(Opcode::AndBool);
  b_.jump_if_false(exit);
  e_.store(statement.target, [&](Width) { b_.local_get(next); });
}

}  // namespace stepwright::codegen
