// EN and ENO (IEC 61131-3, 6.6.1.4 and 6.6.1.7): a call with EN := FALSE does nothing, its ENO is FALSE.
//
// ENO is FALSE, too, if a standard function has no value (error_guard.cpp).
//
// The arguments are part of the call: none is evaluated if it does nothing. The value of a function that was
// not called is the first value of its type.

#include <utility>

#include "ladder/semantics/calls/call_analyzer.h"
#include "ladder/semantics/calls/error_guard.h"

namespace stepwright::semantics::internal {

using syntax::Expression;

namespace {

bool declares(const Pou* pou, const syntax::Argument* argument) {
  return pou != nullptr && argument != nullptr && pou->find(argument->formal->id) != nullptr;
}

}  // namespace

// The slot that holds EN, set by the last of `before`; nothing after a report. ENO is passed on behind.
std::optional<Place> CallAnalyzer::enable_slot(const Expression& call, std::vector<CopyBefore>& before,
                                               std::vector<CopyAfter>& after) {
  const Type* boolean = a_.type_table().boolean();
  ValuePtr enable = make_constant({1}, boolean, call.where);
  if (call.enable) enable = call.enable->value ? e_.value_as(*call.enable->value, boolean) : nullptr;
  if (!enable) return std::nullopt;
  pou_->slots.push_back(bytecode::StackType::Bool);
  Place slot;
  slot.base = Base::Slot;
  slot.slot = static_cast<std::uint32_t>(pou_->slots.size() - 1);
  slot.type = boolean;
  before.push_back({copy_direct(slot), std::move(enable)});
  if (call.enabled && !pass_output(*call.enabled, copy_direct(slot), after)) return std::nullopt;
  return slot;
}

ValuePtr CallAnalyzer::enabled(ValuePtr called, const Expression& call) {
  const Pou* pou = called->kind == ValueKind::Call ? called->pou : nullptr;
  const bool has_enable = call.enable && !declares(pou, call.enable.get());
  const bool has_enabled = call.enabled && !declares(pou, call.enabled.get());
  if (!has_enable && !has_enabled) return called;
  if (pou_ == nullptr) {
    a_.error(code::kNotConstant, call.where, "the value must be known when the program is compiled");
    return nullptr;
  }
  called = e_.conversions().settle(std::move(called));
  if (!called) return nullptr;
  ValuePtr result = make(ValueKind::Enabled, called->type, call.where);
  auto slot = enable_slot(call, result->before, result->after);
  if (!slot) return nullptr;
  ErrorGuard guard(a_, e_, *pou_);
  if (has_enabled) called = guard.unless_error(std::move(called), *slot);
  if (!called) return nullptr;
  result->operands.push_back(load(std::move(*slot), call.where));
  guard.add_or_first(*result, std::move(called));
  return result;
}

Statement CallAnalyzer::enabled_block(Statement called, const Expression& call) {
  const Pou* pou = called.target.type->pou;
  const bool has_enable = call.enable && !declares(pou, call.enable.get());
  const bool has_enabled = call.enabled && !declares(pou, call.enabled.get());
  if (!has_enable && !has_enabled) return called;
  Statement result;
  result.kind = StatementKind::If;
  result.where = call.where;
  auto slot = enable_slot(call, result.before, result.after);
  if (!slot) return called;
  Branch branch;
  branch.condition = load(std::move(*slot), call.where);
  branch.body.push_back(std::move(called));
  result.branches.push_back(std::move(branch));
  return result;
}

}  // namespace stepwright::semantics::internal
