// What one statement shows by itself.

#include <algorithm>

#include "ladder/lint/internal/body_walker.h"
#include "ladder/semantics/types/operator_group.h"
#include "ladder/source/codes.h"

namespace stepwright::lint::internal {

namespace code = source::code;
using syntax::Expression;
using syntax::ExpressionKind;
using syntax::Operator;

bool same(const Expression& a, const Expression& b) {
  if (a.kind != b.kind || a.op != b.op || a.operands.size() != b.operands.size()) return false;
  switch (a.kind) {
    case ExpressionKind::Call:
    case ExpressionKind::Error:
    case ExpressionKind::StructValues:
      return false;
    case ExpressionKind::Variable:
    case ExpressionKind::EnumValue:
    case ExpressionKind::Field:
      if (!(a.name.id == b.name.id)) return false;
      break;
    case ExpressionKind::Direct:
      if (!(a.address == b.address)) return false;
      break;
    default:
      if (a.integer != b.integer || a.real != b.real || a.time_ns != b.time_ns ||
          a.characters != b.characters || a.part_bits != b.part_bits)
        return false;
  }
  return std::equal(a.operands.begin(), a.operands.end(), b.operands.begin(),
                    [](const auto& x, const auto& y) { return x && y && same(*x, *y); });
}

// Statements that a lowering made are not the user's; what a chart copied from its text is.
bool BodyWalker::speaks_of(Position where) const {
  if (pou_.declaration->origin == syntax::BodyOrigin::Text) return true;
  return pou_.declaration->origin == syntax::BodyOrigin::Chart && where.file == pou_.where.file;
}

// Holds nothing but literals.
bool BodyWalker::is_constant(const Expression& each) const {
  switch (each.kind) {
    case ExpressionKind::Boolean:
    case ExpressionKind::Integer:
    case ExpressionKind::Real:
    case ExpressionKind::Time:
      return true;
    case ExpressionKind::Unary:
    case ExpressionKind::Binary:
      return std::all_of(each.operands.begin(), each.operands.end(),
                         [&](const auto& operand) { return operand && is_constant(*operand); });
    default:
      return false;
  }
}

// `v := v OR x`, `v := v AND NOT x`: other places may have their say too.
bool BodyWalker::keeps_value(const Expression& target, const Expression& value) const {
  if (value.kind != ExpressionKind::Binary || (value.op != Operator::Or && value.op != Operator::And))
    return false;
  return std::any_of(value.operands.begin(), value.operands.end(),
                     [&](const auto& operand) { return operand && same(target, *operand); });
}

void BodyWalker::check_condition(const Expression& condition) {
  if (!speaks_of(condition.where)) return;
  const bool compares = condition.kind == ExpressionKind::Binary && condition.operands.size() == 2 &&
                        semantics::is_comparison(condition.op);
  const bool itself = compares && same(*condition.operands[0], *condition.operands[1]);
  if (itself) {
    sink_.warning(code::kConstantCondition, condition.where, "this compares something with itself");
  } else if (is_constant(condition)) {
    sink_.warning(code::kConstantCondition, condition.where, "this condition never changes",
                  "a switch of the program is clearer as VAR CONSTANT");
  }
}

void BodyWalker::check_effect(const syntax::Statement& assignment) {
  if (speaks_of(assignment.where) && same(*assignment.target, *assignment.value))
    sink_.warning(code::kNoEffect, assignment.where, "this assignment changes nothing");
}

void BodyWalker::check_empty(const syntax::Statements& body, Position where, const char* what) {
  if (level_ == Level::All && body.empty() && speaks_of(where))
    sink_.warning(code::kEmptyBody, where, std::string("nothing stands behind ") + what);
}

void BodyWalker::check_ignored(const Expression& call) {
  if (call.kind != ExpressionKind::Call || !speaks_of(call.where)) return;
  const semantics::Pou* callee = callee_of(call);
  if (callee == nullptr || callee->kind != semantics::PouKind::Function || !callee->has_result) return;
  uses_.dropped.emplace_back(call.where, callee);
}

bool BodyWalker::changed_since(const Expression& condition, std::uint64_t writes) {
  if (condition.kind == ExpressionKind::Call || condition.kind == ExpressionKind::Dereference) return true;
  if (condition.kind == ExpressionKind::Variable) {
    const VariableUse* use = uses_.find(index_, condition.name.id);
    if (use == nullptr) return false;
    const bool shared = use->variable->section == semantics::Section::Global ||
                        use->variable->section == semantics::Section::InOut;
    return use->last_write > writes || last_unknown_ > writes || (shared && last_foreign_ > writes);
  }
  if (condition.kind == ExpressionKind::Direct) return condition.address.area != syntax::Area::Input;
  return std::any_of(condition.operands.begin(), condition.operands.end(),
                     [&](const auto& operand) { return operand && changed_since(*operand, writes); });
}

}  // namespace stepwright::lint::internal
