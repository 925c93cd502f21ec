#include "ladder/semantics/expressions/expression_analyzer.h"

#include <utility>

#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::semantics::internal {

using syntax::Expression;
using syntax::ExpressionKind;

namespace {

ElementaryType time_type(ExpressionKind kind) {
  switch (kind) {
    case ExpressionKind::Date:
      return ElementaryType::Date;
    case ExpressionKind::TimeOfDay:
      return ElementaryType::Tod;
    case ExpressionKind::DateAndTime:
      return ElementaryType::Dt;
    default:
      return ElementaryType::Time;
  }
}

}  // namespace

ValuePtr ExpressionAnalyzer::value(const Expression& expression) {
  if (expression.prefix && expression.kind != ExpressionKind::EnumValue) return typed_literal(expression);
  switch (expression.kind) {
    case ExpressionKind::Boolean:
    case ExpressionKind::Integer:
    case ExpressionKind::Real:
    case ExpressionKind::Time:
    case ExpressionKind::Date:
    case ExpressionKind::TimeOfDay:
    case ExpressionKind::DateAndTime:
    case ExpressionKind::Null:
      return literal(expression);
    case ExpressionKind::Variable:
      return variable(expression);
    case ExpressionKind::EnumValue:
      return enum_value(expression);
    case ExpressionKind::Field:
      if (bool known = false; ValuePtr enumerator = dotted_enumerator(expression, known)) {
        return enumerator;
      } else if (known) {
        return nullptr;
      } else if (const Variable* global = places_.qualified_global(expression);
                 global != nullptr && global->value) {
        const Type* type = global->type->kind == TypeKind::Subrange ? global->type->base : global->type;
        return make_constant(*global->value, type, expression.where);
      }
      [[fallthrough]];
    case ExpressionKind::Direct:
    case ExpressionKind::Index:
    case ExpressionKind::Dereference:
    case ExpressionKind::Part: {
      auto found = places_.place(expression, Access::Read);
      return found ? load(std::move(*found), expression.where) : nullptr;
    }
    case ExpressionKind::Unary:
      return unary(expression);
    case ExpressionKind::Binary:
      return binary(expression);
    case ExpressionKind::Call: {
      ValuePtr result = a_.value_of_call(a_, *this, pou_, expression);
      if (!result || result->type->kind != TypeKind::Nothing) return result;
      a_.error(code::kNoResult, expression.where,
               "the function " + quote(expression.name.text) + " has no result",
               "call it as a statement and take its outputs with '=>'");
      return nullptr;
    }
    case ExpressionKind::ArrayValues:
    case ExpressionKind::StructValues:
    case ExpressionKind::Repeat:
      a_.error(code::kBadInitializer, expression.where, "a list of values can only initialise a variable");
      return nullptr;
    case ExpressionKind::String:
    case ExpressionKind::WideString:
      return text_literal(expression);
    case ExpressionKind::Error:
      break;
  }
  return nullptr;
}

ValuePtr ExpressionAnalyzer::literal(const Expression& expression) {
  const TypeTable& types = a_.type_table();
  switch (expression.kind) {
    case ExpressionKind::Boolean:
      return make_constant({static_cast<__int128>(expression.integer)}, types.boolean(), expression.where);
    case ExpressionKind::Integer:
      return make_constant({static_cast<__int128>(expression.integer)}, types.any_integer(),
                           expression.where);
    case ExpressionKind::Real:
      return make_constant({0, expression.real}, types.any_real(), expression.where);
    case ExpressionKind::Null:
      return make_constant({bytecode::kNullRef}, types.null(), expression.where);
    default:
      return make_constant({expression.time_ns}, types.elementary(time_type(expression.kind)),
                           expression.where);
  }
}

// INT#5, WORD#16#FF, REAL#1
ValuePtr ExpressionAnalyzer::typed_literal(const Expression& expression) {
  const Type* type = explicit_.named_type(a_.names.folded(expression.prefix->id));
  if (type == nullptr) {
    a_.error(code::kUnknownType, expression.prefix->where,
             quote(expression.prefix->text) + " is no elementary type");
    return nullptr;
  }
  ValuePtr inner;
  if (expression.kind == ExpressionKind::Unary) {
    inner = unary(expression);
  } else if (expression.kind == ExpressionKind::String || expression.kind == ExpressionKind::WideString) {
    inner = text_literal(expression);
  } else {
    inner = literal(expression);
  }
  return inner ? conversions_.convert(std::move(inner), type, expression.where) : nullptr;
}

ValuePtr ExpressionAnalyzer::variable(const Expression& expression) {
  const syntax::Name& name = expression.name;
  if (a_.numbered != nullptr)
    if (const Enumerator* before = a_.numbered->find_enumerator(name.id))
      return make_constant({before->value}, a_.numbered->base, expression.where);
  const Variable* found = places_.find_variable(name.id);
  if (found == nullptr) {
    const auto known = a_.enum_values.find(name.id.value);
    if (known != a_.enum_values.end()) return enum_value(expression);
  } else if (found->value) {
    const Type* type = found->type->kind == TypeKind::Subrange ? found->type->base : found->type;
    return make_constant(*found->value, type, expression.where);
  }
  auto at = places_.place(expression, Access::Read);
  return at ? load(std::move(*at), expression.where) : nullptr;
}

// "Red" or "Color#Red"
ValuePtr ExpressionAnalyzer::enum_value(const Expression& expression) {
  const syntax::Name& name = expression.name;
  if (!expression.prefix) {
    const EnumValue& found = a_.enum_values.at(name.id.value);
    if (found.type != nullptr) return make_constant({found.value}, found.type, expression.where);
    // The context says which of several enumerations is meant.
    return make_constant({name.id.value}, a_.type_table().any_enumerator(), name.where);
  }
  if (a_.numbered != nullptr && naming::same_name(a_.numbered->name, expression.prefix->text))
    if (const Enumerator* before = a_.numbered->find_enumerator(name.id))
      return make_constant({before->value}, a_.numbered->base, expression.where);
  const auto type = a_.types.find(expression.prefix->id.value);
  if (type == a_.types.end() || (type->second != nullptr && type->second->kind != TypeKind::Enumeration)) {
    // Of a name that is no type at all it was said before.
    if (type == a_.types.end() &&
        a_.unknown.contains({nullptr, "there is no type " + quote(expression.prefix->text)}))
      return nullptr;
    a_.error(code::kUnknownType, expression.prefix->where,
             quote(expression.prefix->text) + " is no enumeration");
    return nullptr;
  }
  if (type->second == nullptr) return nullptr;
  if (const Enumerator* found = type->second->find_enumerator(name.id))
    return make_constant({found->value}, type->second, expression.where);
  a_.unknown_name(code::kUnknownMember, pou_, name.where,
                  quote(type->second->name) + " has no value " + quote(name.text));
  return nullptr;
}

ValuePtr ExpressionAnalyzer::settled_value(const Expression& expression) {
  return conversions_.settle(value(expression));
}

ValuePtr ExpressionAnalyzer::value_as(const Expression& expression, const Type* type) {
  ValuePtr found = value(expression);
  if (!found || type == nullptr) return nullptr;
  return conversions_.convert(std::move(found), type, expression.where);
}

ValuePtr ExpressionAnalyzer::condition(const Expression& expression, const char* what) {
  ValuePtr found = value(expression);
  if (!found) return nullptr;
  if (!found->type->is_bool()) {
    a_.error(code::kTypeMismatch, expression.where,
             std::string(what) + " must be BOOL, not " + found->type->name,
             found->type->is_number() ? "compare it, for instance with '<> 0'" : "");
    return nullptr;
  }
  return found;
}

std::optional<Constant> ExpressionAnalyzer::constant(const Expression& expression, const Type* type) {
  const ValuePtr found = value_as(expression, type);
  if (!found) return std::nullopt;
  if (found->kind != ValueKind::Constant) {
    a_.error(code::kNotConstant, expression.where, "the value must be known when the program is compiled",
             "use a literal or a variable declared CONSTANT");
    return std::nullopt;
  }
  return found->constant;
}

std::optional<std::int64_t> ExpressionAnalyzer::constant_integer(const Expression& expression) {
  const ValuePtr found = conversions_.bits().counted(settled_value(expression));
  if (!found) return std::nullopt;
  if (!found->type->is_integer()) {
    a_.error(code::kTypeMismatch, expression.where, "an integer is needed here, not " + found->type->name,
             conversions_.bits().bits_hint(*found->type));
    return std::nullopt;
  }
  if (found->kind != ValueKind::Constant) {
    a_.error(code::kNotConstant, expression.where, "the value must be known when the program is compiled",
             "use a literal or a variable declared CONSTANT");
    return std::nullopt;
  }
  if (!fits(found->constant, *a_.type_table().elementary(ElementaryType::Lint))) {
    a_.error(code::kOutOfRange, expression.where, "the number is too large here");
    return std::nullopt;
  }
  return static_cast<std::int64_t>(found->constant.integer);
}

// 'abc' or "abc"
ValuePtr ExpressionAnalyzer::text_literal(const Expression& expression) {
  const bool wide = expression.kind == ExpressionKind::WideString;
  if (expression.characters.size() > bytecode::kMaxStringCapacity) {
    a_.error(code::kLiteralRange, expression.where, "a string has at most 65535 characters");
    return nullptr;
  }
  const Type* type = a_.type_table().string(wide ? ElementaryType::Wstring : ElementaryType::String,
                                            static_cast<std::uint32_t>(expression.characters.size()));
  return make_constant({0, 0, expression.characters}, type, expression.where);
}

ValuePtr ExpressionAnalyzer::unary(const Expression& expression) {
  return operators_.unary(expression.op, value(*expression.operands[0]), expression.where);
}

ValuePtr ExpressionAnalyzer::binary(const Expression& expression) {
  ValuePtr result = value(*expression.operands[0]);
  for (std::size_t i = 1; i < expression.operands.size(); ++i) {
    // The others are analysed even after a mistake: each may have its own.
    ValuePtr right = value(*expression.operands[i]);
    result = result && right
                 ? operators_.combine(expression.op, std::move(result), std::move(right), expression.where)
                 : nullptr;
  }
  return result;
}

}  // namespace stepwright::semantics::internal
