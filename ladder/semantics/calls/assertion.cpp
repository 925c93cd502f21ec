// ASSERT_...: what is compared is kept in the instance of the test, where the runner finds it.

#include <algorithm>
#include <utility>

#include "ladder/semantics/calls/test_analyzer.h"

namespace stepwright::semantics::internal {

using syntax::Argument;
using syntax::Expression;
using syntax::Operator;

namespace {

// As they lie in a TestEvent.
enum Role : std::size_t { kActual, kExpected, kTolerance };

}  // namespace

struct TestAnalyzer::Operands {
  std::vector<ValuePtr> values;  // by role
  std::vector<Position> where;   // by role
  Block copies;                  // of the values into what is kept
  std::optional<TestOperand> kept[3];
  ValuePtr holds;  // BOOL: the assertion is true
};

std::optional<Statement> TestAnalyzer::assertion(const Form& form, const Expression& call,
                                                 const std::vector<const Argument*>& arguments) {
  Operands operands;
  const Argument* text = arguments.back();
  const Type* string = a_.type_table().string(ElementaryType::String, TestHeader::kMessageCapacity);
  ValuePtr message = text != nullptr ? expressions_.value_as(*text->value, string) : nullptr;
  if (!read_operands(form, call, arguments, operands) || (text != nullptr && !message)) return std::nullopt;

  TestEvent& event = add_event(form, call);
  event.actual_text = arguments[0]->text;
  event.actual = operands.kept[kActual];
  event.expected = operands.kept[kExpected];
  event.tolerance = operands.kept[kTolerance];
  event.has_message = message != nullptr;

  Statement block;
  block.kind = StatementKind::If;
  block.where = call.where;
  Block& body = block.branches.emplace_back().body;
  body = std::move(operands.copies);
  Statement& fails = body.emplace_back();
  fails.kind = StatementKind::If;
  fails.where = call.where;
  Branch& branch = fails.branches.emplace_back();
  branch.condition = expressions_.operators().invert(std::move(operands.holds), call.where);
  if (message) {
    Statement& copy = branch.body.emplace_back();
    copy.kind = StatementKind::Assign;
    copy.where = text->value->where;
    copy.target = header(TestHeader::kMessage, string);
    copy.value = std::move(message);
  }
  branch.body.push_back(leave_with_event(call.where));
  Statement& leave = branch.body.emplace_back();
  leave.kind = StatementKind::Return;
  leave.where = call.where;
  return block;
}

bool TestAnalyzer::read_operands(const Form& form, const Expression& call,
                                 const std::vector<const Argument*>& arguments, Operands& out) {
  if (form.kind == Form::Kind::Truth) {
    out.holds = expressions_.condition(*arguments[0]->value, "what is asserted");
    if (out.holds && form.op == Operator::NotEqual)
      out.holds = expressions_.operators().invert(std::move(out.holds), call.where);
    return out.holds != nullptr;
  }
  bool sound = true;
  for (std::size_t i = 0; i + 1 < form.formals.size(); ++i) {
    out.values.push_back(expressions_.value(*arguments[i]->value));
    out.where.push_back(arguments[i]->value->where);
    sound = sound && out.values.back() != nullptr;
  }
  if (!sound) return false;
  return form.kind == Form::Kind::Near ? compare_near(call, out) : compare(form, out);
}

// Copies a value into a variable of the test and reads it from there; a text may be shorter than `type`.
ValuePtr TestAnalyzer::keep(ValuePtr value, const Type* type, std::size_t role, Operands& operands) {
  if (!value) return nullptr;
  const Position where = operands.where[role];
  const Place place = hidden(type, role);
  operands.kept[role] = TestOperand{type, place.offset};
  Statement& copy = operands.copies.emplace_back();
  copy.kind = StatementKind::Assign;
  copy.where = where;
  copy.target = copy_direct(place);
  copy.value = std::move(value);
  return load(copy_direct(place), where);
}

bool TestAnalyzer::compare(const Form& form, Operands& operands) {
  ValuePtr& actual = operands.values[kActual];
  ValuePtr& expected = operands.values[kExpected];
  const Position where = operands.where[kExpected];
  if (actual->type->is_literal() && expected->type->is_literal()) {
    actual = expressions_.conversions().settle(std::move(actual));
    expected = expressions_.conversions().settle(std::move(expected));
    if (!actual || !expected) return false;
  }
  const Type* common = expressions_.operators().common_type(*actual, *expected);
  if (common != nullptr && common->kind == TypeKind::Subrange) common = common->base;
  const bool comparable = common != nullptr && (common->is_string() ||
                                                expressions_.operators().operator_applies(form.op, *common));
  // References are compared, but their values mean nothing to a reader.
  if (comparable && !common->is_reference()) {
    actual = expressions_.conversions().convert(std::move(actual), common, operands.where[kActual]);
    expected = expressions_.conversions().convert(std::move(expected), common, where);
    actual = keep(std::move(actual), common, kActual, operands);
    expected = keep(std::move(expected), common, kExpected, operands);
  }
  operands.holds = expressions_.operators().combine(form.op, std::move(actual), std::move(expected), where);
  return operands.holds != nullptr;
}

// |actual - expected| <= tolerance, or both are the same infinity. Durations and dates differ by a TIME.
bool TestAnalyzer::compare_near(const Expression& call, Operands& operands) {
  auto& values = operands.values;
  const bool numbers =
      std::ranges::all_of(values, [](const ValuePtr& each) { return each->type->is_number(); });
  const bool times = values[kTolerance]->type->is_time() &&
                     values[kActual]->type == values[kExpected]->type &&
                     (values[kActual]->type->is_time() || values[kActual]->type->is_date());
  if (!numbers && !times) {
    a_.error(code::kBadOperand, call.where,
             "ASSERT_NEAR cannot be applied to " + plain_name(*values[kActual]->type) + ", " +
                 plain_name(*values[kExpected]->type) + " and " + plain_name(*values[kTolerance]->type),
             "give it three numbers, or two durations or dates and a TIME");
    return false;
  }
  if (numbers) {
    // REAL, unless one of them needs LREAL; literals are as exact as the others.
    const Type* lreal = a_.type_table().elementary(ElementaryType::Lreal);
    const Type* real = nullptr;
    for (ValuePtr& each : values) {
      if (each->type->is_literal()) continue;
      each = expressions_.conversions().as_real(std::move(each));
      if (!each) return false;
      if (real != lreal) real = each->type;
    }
    if (real == nullptr) real = lreal;
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = expressions_.conversions().convert(std::move(values[i]), real, operands.where[i]);
      if (!values[i]) return false;
    }
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Type* type = values[i]->type;
    values[i] = keep(std::move(values[i]), type, i, operands);
  }
  const auto again = [&](std::size_t role) {
    return load(copy_direct(values[role]->place), operands.where[role]);
  };
  const Position where = call.where;
  const auto difference = [&] {
    return expressions_.operators().combine(Operator::Subtract, again(kActual), again(kExpected), where);
  };
  ValuePtr above =
      expressions_.operators().combine(Operator::LessEqual, difference(), again(kTolerance), where);
  ValuePtr minus = make(ValueKind::Unary, values[kTolerance]->type, where);
  minus->op = Operator::Negate;
  minus->operands.push_back(again(kTolerance));
  ValuePtr below =
      expressions_.operators().combine(Operator::GreaterEqual, difference(), std::move(minus), where);
  ValuePtr within =
      expressions_.operators().combine(Operator::And, std::move(above), std::move(below), where);
  ValuePtr equal = expressions_.operators().combine(Operator::Equal, again(kActual), again(kExpected), where);
  operands.holds = expressions_.operators().combine(Operator::Or, std::move(equal), std::move(within), where);
  return operands.holds != nullptr;
}

}  // namespace stepwright::semantics::internal
