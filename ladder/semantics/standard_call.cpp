// Standard functions (IEC 61131-3, 6.6.2.5): each is typed by its arguments.

#include <utility>

#include "ladder/semantics/internal/expression_analyzer.h"

namespace stepwright::semantics::internal {

using syntax::Expression;
using syntax::Operator;

namespace {

struct OperatorFunction {
  const char* name;
  Operator op;
  std::size_t most;
};

// Functions that are operators under another name (tables 28 to 33).
constexpr OperatorFunction kOperatorFunctions[] = {
    {"ADD", Operator::Add, 32},    {"SUB", Operator::Subtract, 2},    {"MUL", Operator::Multiply, 32},
    {"DIV", Operator::Divide, 2},  {"MOD", Operator::Modulo, 2},      {"AND", Operator::And, 32},
    {"OR", Operator::Or, 32},      {"XOR", Operator::Xor, 32},        {"EQ", Operator::Equal, 2},
    {"NE", Operator::NotEqual, 2}, {"LT", Operator::Less, 2},         {"LE", Operator::LessEqual, 2},
    {"GT", Operator::Greater, 2},  {"GE", Operator::GreaterEqual, 2},
};

}  // namespace

ValuePtr ExpressionAnalyzer::standard_call(const Expression& call, const std::string& folded, bool& known) {
  known = true;
  if (folded == "ABS") return numeric(call, StandardFunction::Abs);
  if (folded == "SQRT") return numeric(call, StandardFunction::Sqrt);
  if (folded == "MIN") return extremum(call, StandardFunction::Min);
  if (folded == "MAX") return extremum(call, StandardFunction::Max);
  if (folded == "LIMIT") return limit(call);
  if (folded == "SHL") return shift(call, StandardFunction::Shl);
  if (folded == "SHR") return shift(call, StandardFunction::Shr);
  if (folded == "ROL") return shift(call, StandardFunction::Rol);
  if (folded == "ROR") return shift(call, StandardFunction::Ror);
  if (folded == "SEL") return select(call);
  if (folded == "MUX") return multiplex(call);
  if (folded == "TRUNC") return truncate(call);
  if (folded == "MOVE") {
    auto arguments = standard_arguments(call, {"IN"}, 1, 1);
    return arguments ? std::move(arguments->front()) : nullptr;
  }
  // The clock that the standard's timers are built from; no name that a user's source can hold by accident.
  if (folded == "__NOW")
    return make(ValueKind::Now, a_.type_table().elementary(ElementaryType::Time), call.where);
  for (const OperatorFunction& each : kOperatorFunctions)
    if (folded == each.name) return operator_call(call, each.op, each.most);
  known = false;
  return nullptr;
}

// The arguments in the order of `formals`; positional ones may go on behind the last name (MIN, MUX, ADD).
std::optional<std::vector<ValuePtr>> ExpressionAnalyzer::standard_arguments(
    const Expression& call, std::initializer_list<const char*> formals, std::size_t least, std::size_t most) {
  std::vector<ValuePtr> values(call.arguments.size());
  bool sound = true;
  if (call.arguments.size() < least || call.arguments.size() > most) {
    a_.error(code::kArgumentCount, call.where,
             quote(call.name.text) + " takes " + std::to_string(least) +
                 (most == least ? ""
                  : most >= 32  ? " or more"
                                : " to " + std::to_string(most)) +
                 " arguments, found " + std::to_string(call.arguments.size()));
    return std::nullopt;
  }
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    const syntax::Argument& argument = call.arguments[i];
    std::size_t target = i;
    if (argument.formal) {
      const std::string& wanted = a_.names.folded(argument.formal->id);
      target = values.size();
      std::size_t position = 0;
      for (const char* formal : formals) {
        if (wanted == formal) target = position;
        ++position;
      }
      // IN1, IN2, ... of the functions that take any number.
      if (target == values.size() && most > formals.size() && wanted.size() <= 4 &&
          wanted.rfind("IN", 0) == 0 && wanted.find_first_not_of("0123456789", 2) == std::string::npos &&
          wanted.size() > 2) {
        const std::size_t first = formals.size() == 0 ? 1 : 0;  // MUX counts from IN0 behind K
        target = static_cast<std::size_t>(std::stoul(wanted.substr(2))) - first + formals.size();
      }
      if (target >= values.size() || argument.is_output) {
        a_.error(code::kUnknownParameter, argument.formal->where,
                 quote(call.name.text) + " has no parameter " + quote(argument.formal->text));
        sound = false;
        continue;
      }
    }
    if (values[target]) {
      a_.error(code::kDuplicateArgument, argument.value->where, "the argument is given twice");
      sound = false;
    }
    values[target] = value(*argument.value);
    sound = sound && values[target];
  }
  if (!sound) return std::nullopt;
  return values;
}

const Type* ExpressionAnalyzer::unify(std::vector<ValuePtr>& values, std::size_t first, Position where) {
  // Literals adapt to what has a type, so they are looked at last.
  std::size_t model = first;
  while (model + 1 < values.size() && values[model]->type->is_literal()) ++model;
  const Type* common = values[model]->type;
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = first; i < values.size(); ++i) {
      Value stand_in;
      stand_in.type = common;
      if (common->is_literal()) stand_in.constant = values[model]->constant;
      const Type* wider = common_type(stand_in, *values[i]);
      if (wider == nullptr) {
        mismatch(*values[i]->type, *common, values[i]->where);
        return nullptr;
      }
      common = wider;
    }
  }
  for (std::size_t i = first; i < values.size(); ++i) {
    values[i] =
        common->is_literal() ? settle(std::move(values[i])) : convert(std::move(values[i]), common, where);
    if (!values[i]) return nullptr;
  }
  if (!common->is_literal()) return common;
  // Literals only: the widest of their own types.
  return unify(values, first, where);
}

ValuePtr ExpressionAnalyzer::numeric(const Expression& call, StandardFunction function) {
  auto arguments = standard_arguments(call, {"IN"}, 1, 1);
  if (!arguments) return nullptr;
  ValuePtr operand = settle(std::move(arguments->front()));
  if (!operand) return nullptr;
  if (!operand->type->is_number()) {
    a_.error(code::kBadOperand, call.where,
             quote(call.name.text) + " cannot be applied to " + operand->type->name);
    return nullptr;
  }
  if (function == StandardFunction::Sqrt && !operand->type->is_real()) {
    const TypeTable& types = a_.type_table();
    const Type* real = types.elementary(ElementaryType::Real);
    if (!widens(*operand->type, *real)) real = types.elementary(ElementaryType::Lreal);
    operand = convert(std::move(operand), real, call.where);
    if (!operand) return nullptr;
  }
  ValuePtr result = make(ValueKind::Standard, operand->type, call.where);
  result->function = function;
  result->operands.push_back(std::move(operand));
  return result;
}

ValuePtr ExpressionAnalyzer::extremum(const Expression& call, StandardFunction function) {
  auto arguments = standard_arguments(call, {}, 2, 32);
  if (!arguments) return nullptr;
  const Type* type = unify(*arguments, 0, call.where);
  if (type == nullptr) return nullptr;
  if (!type->is_number() && !type->is_time()) {
    a_.error(code::kBadOperand, call.where, quote(call.name.text) + " cannot be applied to " + type->name);
    return nullptr;
  }
  ValuePtr result = make(ValueKind::Standard, type, call.where);
  result->function = function;
  result->operands = std::move(*arguments);
  return result;
}

// LIMIT(MN, IN, MX) = MIN(MAX(IN, MN), MX)
ValuePtr ExpressionAnalyzer::limit(const Expression& call) {
  auto arguments = standard_arguments(call, {"MN", "IN", "MX"}, 3, 3);
  if (!arguments) return nullptr;
  const Type* type = unify(*arguments, 0, call.where);
  if (type == nullptr) return nullptr;
  if (!type->is_number() && !type->is_time()) {
    a_.error(code::kBadOperand, call.where, "'LIMIT' cannot be applied to " + type->name);
    return nullptr;
  }
  ValuePtr lower = make(ValueKind::Standard, type, call.where);
  lower->function = StandardFunction::Max;
  lower->operands.push_back(std::move((*arguments)[1]));
  lower->operands.push_back(std::move((*arguments)[0]));
  ValuePtr result = make(ValueKind::Standard, type, call.where);
  result->function = StandardFunction::Min;
  result->operands.push_back(std::move(lower));
  result->operands.push_back(std::move((*arguments)[2]));
  return result;
}

ValuePtr ExpressionAnalyzer::shift(const Expression& call, StandardFunction function) {
  auto arguments = standard_arguments(call, {"IN", "N"}, 2, 2);
  if (!arguments) return nullptr;
  ValuePtr& operand = (*arguments)[0];
  if (!operand->type->is_bits()) {
    a_.error(code::kBadOperand, call.where,
             quote(call.name.text) + " cannot be applied to " + operand->type->name,
             "it works on BYTE, WORD, DWORD and LWORD; a literal needs a type: WORD#16#1");
    return nullptr;
  }
  const TypeTable& types = a_.type_table();
  ValuePtr count = convert(std::move((*arguments)[1]), types.elementary(ElementaryType::Dint), call.where);
  if (!count) return nullptr;
  ValuePtr result = make(ValueKind::Shift, operand->type, call.where);
  result->function = function;
  result->operands.push_back(std::move(operand));
  result->operands.push_back(std::move(count));
  return result;
}

ValuePtr ExpressionAnalyzer::select(const Expression& call) {
  auto arguments = standard_arguments(call, {"G", "IN0", "IN1"}, 3, 3);
  if (!arguments) return nullptr;
  (*arguments)[0] = convert(std::move((*arguments)[0]), a_.type_table().boolean(), call.where);
  if (!(*arguments)[0]) return nullptr;
  const Type* type = unify(*arguments, 1, call.where);
  if (type == nullptr) return nullptr;
  if (!type->is_scalar()) {
    a_.error(code::kBadOperand, call.where, "'SEL' cannot be applied to " + type->name);
    return nullptr;
  }
  ValuePtr result = make(ValueKind::Select, type, call.where);
  result->operands = std::move(*arguments);
  return result;
}

ValuePtr ExpressionAnalyzer::multiplex(const Expression& call) {
  auto arguments = standard_arguments(call, {"K"}, 2, 33);
  if (!arguments) return nullptr;
  (*arguments)[0] =
      convert(std::move((*arguments)[0]), a_.type_table().elementary(ElementaryType::Dint), call.where);
  if (!(*arguments)[0]) return nullptr;
  const Type* type = unify(*arguments, 1, call.where);
  if (type == nullptr) return nullptr;
  if (!type->is_scalar()) {
    a_.error(code::kBadOperand, call.where, "'MUX' cannot be applied to " + type->name);
    return nullptr;
  }
  ValuePtr result = make(ValueKind::Multiplex, type, call.where);
  result->operands = std::move(*arguments);
  return result;
}

ValuePtr ExpressionAnalyzer::truncate(const Expression& call) {
  auto arguments = standard_arguments(call, {"IN"}, 1, 1);
  if (!arguments) return nullptr;
  ValuePtr operand = settle(std::move(arguments->front()));
  if (!operand) return nullptr;
  if (!operand->type->is_real()) {
    a_.error(code::kBadOperand, call.where, "'TRUNC' cannot be applied to " + operand->type->name);
    return nullptr;
  }
  ValuePtr result = make(ValueKind::Truncate, a_.type_table().elementary(ElementaryType::Dint), call.where);
  result->operands.push_back(std::move(operand));
  return result;
}

ValuePtr ExpressionAnalyzer::operator_call(const Expression& call, Operator op, std::size_t most) {
  auto arguments = standard_arguments(call, {}, 2, most);
  if (!arguments) return nullptr;
  ValuePtr result = std::move(arguments->front());
  for (std::size_t i = 1; i < arguments->size() && result; ++i)
    result = combine(op, std::move(result), std::move((*arguments)[i]), call.where);
  return result;
}

}  // namespace stepwright::semantics::internal
