#include "ladder/codegen/function_emitter.h"

#include <algorithm>
#include <utility>

#include "ladder/codegen/machine_type.h"

namespace stepwright::codegen {

using bytecode::Opcode;
using semantics::Statement;
using semantics::StatementKind;
using semantics::Type;
using semantics::ValueKind;
using syntax::Operator;
using writer::Label;
using writer::LocalId;

namespace {

bytecode::FunctionKind kind_of(semantics::PouKind kind) {
  switch (kind) {
    case semantics::PouKind::Program:
      return bytecode::FunctionKind::Program;
    case semantics::PouKind::FunctionBlock:
      return bytecode::FunctionKind::FunctionBlock;
    default:
      return bytecode::FunctionKind::Function;
  }
}

}  // namespace

FunctionEmitter::FunctionEmitter(const ProgramLayout& layout, FileTable& files, const semantics::Pou& pou)
    : pou_(pou),
      b_(pou.spelling, kind_of(pou.kind), pou.type != nullptr ? pou.type->size : 0),
      limits_(*layout.limits),
      e_(layout, files, b_) {
  for (std::size_t i = 0; i < pou.slots.size(); ++i) {
    if (i < pou.parameter_count) {
      b_.add_param(pou.slots[i]);
    } else {
      b_.add_local(pou.slots[i]);
    }
  }
  if (has_slot_result()) b_.set_result(semantics::slot_type(*pou.result));
  // The frame of the POU is one piece; what emitting needs besides lies behind it.
  if (pou.frame_size > 0) b_.allocate_frame(pou.frame_size, 8);
  for (std::uint32_t i = 0; i < pou.label_count; ++i) labels_.push_back(b_.new_label());
}

writer::Function FunctionEmitter::run() && {
  if (b_.local_count() > bytecode::kMaxLocals) limits_.too_many_locals(pou_, last_slot());
  block(pou_.entry);
  block(pou_.body);
  e_.line(pou_.end);
  leave();
  return std::move(b_).take();
}

void FunctionEmitter::leave() {
  if (has_slot_result()) b_.local_get(LocalId(pou_.result_slot));
  b_.emit(Opcode::Return);
}

// The variable that is one too many for the locals.
source::Position FunctionEmitter::last_slot() const {
  for (const semantics::Variable& each : pou_.variables) {
    const semantics::Base base = each.place.base;
    const bool in_slot = base == semantics::Base::Slot || base == semantics::Base::SlotRef;
    if (in_slot && each.place.slot >= bytecode::kMaxLocals) return each.where;
  }
  return pou_.where;
}

void FunctionEmitter::block(const semantics::Block& statements) {
  for (const Statement& each : statements) {
    const bool room = b_.local_count() <= bytecode::kMaxLocals;
    statement(each);
    if (room && b_.local_count() > bytecode::kMaxLocals) limits_.too_many_locals(pou_, each.where);
  }
}

void FunctionEmitter::statement(const Statement& statement) {
  e_.line(statement.where);
  e_.begin_statement();
  switch (statement.kind) {
    case StatementKind::Assign:
      if (statement.initial) return e_.copy_bytes(statement.target, *statement.value);
      return e_.assign(statement.target, *statement.value);
    case StatementKind::Evaluate:
      e_.value(*statement.value);
      if (statement.value->type->kind != semantics::TypeKind::Nothing) b_.emit(Opcode::Drop);
      return;
    case StatementKind::Instance:
      return instance(statement);
    case StatementKind::If:
      return branches(statement);
    case StatementKind::Case:
      return select(statement);
    case StatementKind::For:
      return count(statement);
    case StatementKind::While:
      return while_loop(statement);
    case StatementKind::Repeat:
      return repeat_loop(statement);
    case StatementKind::Exit:
      return b_.jump(loops_.back().exit);
    case StatementKind::Continue:
      return b_.jump(loops_.back().next);
    case StatementKind::Return:
      return leave();
    case StatementKind::Jump:
      return b_.jump(labels_[statement.label]);
    case StatementKind::Label:
      return label(statement.label);
  }
}

// Who jumps into a loop from outside comes without its locals: the limit and the step are read again. Only
// tests do that, whose limits are variables of the instance (semantics/test_analyzer).
void FunctionEmitter::label(std::uint32_t label) {
  b_.bind(labels_[label]);
  for (const Loop& loop : loops_) {
    for (const auto& [value, local] : loop.kept) {
      e_.value(*value);
      b_.local_set(local);
    }
  }
}

void FunctionEmitter::instance(const Statement& statement) {
  e_.copies_before(statement.before);
  if (statement.passes_only) return e_.copies_after(statement.after);
  const semantics::Place& target = statement.target;
  const std::uint32_t function = e_.function_of(*target.type->pou);
  e_.call_site(statement.where, *target.type->pou);
  if (!target.is_direct()) {
    e_.reference(target);
    b_.call_instance(bytecode::AddressMode::Ind, function);
  } else if (e_.in_area(target)) {
    b_.call_instance(bytecode::AddressMode::Abs, function, e_.address(target));
  } else {
    b_.call_instance(bytecode::AddressMode::This, function, target.offset);
  }
  e_.copies_after(statement.after);
}

void FunctionEmitter::branches(const Statement& statement) {
  e_.copies_before(statement.before);
  const Label end = b_.new_label();
  for (const semantics::Branch& each : statement.branches) {
    if (!each.condition) {
      block(each.body);
      break;
    }
    const Label next = b_.new_label();
    e_.line(each.condition->where);
    e_.value(*each.condition);
    b_.jump_if_false(next);
    block(each.body);
    if (&each != &statement.branches.back()) b_.jump(end);
    b_.bind(next);
  }
  b_.bind(end);
  e_.copies_after(statement.after);
}

void FunctionEmitter::case_test(const semantics::CaseRange& range, LocalId selector, const Type& type) {
  b_.local_get(selector);
  e_.constant(range.low, type);
  if (range.low.integer == range.high.integer) return e_.operation(Operator::Equal, type);
  e_.operation(Operator::GreaterEqual, type);
  b_.local_get(selector);
  e_.constant(range.high, type);
  e_.operation(Operator::LessEqual, type);
  b_.emit(Opcode::AndBool);
}

void FunctionEmitter::select(const Statement& statement) {
  const Type& type = *statement.value->type;
  const LocalId selector = e_.held_local(semantics::slot_type(type));
  e_.value(*statement.value);
  b_.local_set(selector);
  const Label end = b_.new_label();
  for (const semantics::Branch& each : statement.branches) {
    if (each.ranges.empty()) {
      block(each.body);
      break;
    }
    const Label body = b_.new_label();
    const Label next = b_.new_label();
    for (const semantics::CaseRange& range : each.ranges) {
      case_test(range, selector, type);
      if (&range == &each.ranges.back()) {
        b_.jump_if_false(next);
      } else {
        b_.jump_if_true(body);
      }
    }
    b_.bind(body);
    block(each.body);
    if (&each != &statement.branches.back()) b_.jump(end);
    b_.bind(next);
  }
  b_.bind(end);
  e_.release(selector, semantics::slot_type(type));
}

void FunctionEmitter::body(const Statement& statement, const Loop& loop) {
  loops_.push_back(loop);
  block(statement.body);
  loops_.pop_back();
}

void FunctionEmitter::while_loop(const Statement& statement) {
  const Loop loop{b_.new_label(), b_.new_label()};
  b_.bind(loop.next);
  e_.value(*statement.value);
  b_.jump_if_false(loop.exit);
  body(statement, loop);
  b_.jump(loop.next);
  b_.bind(loop.exit);
}

void FunctionEmitter::repeat_loop(const Statement& statement) {
  const Loop loop{b_.new_label(), b_.new_label()};
  const Label start = b_.new_label();
  b_.bind(start);
  body(statement, loop);
  b_.bind(loop.next);
  e_.line(statement.value->where);
  e_.value(*statement.value);
  b_.jump_if_false(start);
  b_.bind(loop.exit);
}

}  // namespace stepwright::codegen
