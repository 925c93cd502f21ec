// Calls of user functions and function blocks (IEC 61131-3, 6.6.1.7).

#include <algorithm>
#include <utility>

#include "ladder/semantics/internal/standard_analyzer.h"
#include "ladder/source/suggestion.h"

namespace stepwright::semantics::internal {

using syntax::Argument;
using syntax::Expression;

namespace {

bool is_parameter(const Variable& variable) {
  return variable.section == Section::Input || variable.section == Section::Output ||
         variable.section == Section::InOut;
}

// A name like "INT_TO_REEL" is a conversion to a type that does not exist; else what the name is near to.
std::string unknown_function_hint(const std::string& folded,
                                  const std::vector<std::string_view>& candidates) {
  const std::size_t middle = folded.rfind("TO_");
  if (middle == std::string::npos) return source::did_you_mean(folded, candidates);
  std::vector<std::string_view> types = {"STRING", "WSTRING"};
  for (std::uint8_t i = 0; i < bytecode::kScalarTypeCount; ++i)
    types.emplace_back(bytecode::name_of(static_cast<ElementaryType>(i)));
  std::string hint = source::did_you_mean(folded.substr(middle + 3), types);
  return hint.empty() ? source::did_you_mean(folded, candidates) : hint;
}

}  // namespace

void ExpressionAnalyzer::note_callee(const Pou& callee) {
  if (pou_ == nullptr) return;
  auto& known = pou_->callees;
  if (std::find(known.begin(), known.end(), &callee) == known.end()) known.push_back(&callee);
}

ValuePtr ExpressionAnalyzer::call(const Expression& expression) {
  if (!expression.operands.empty()) {
    a_.error(code::kNoResult, expression.where, "a function block has no result",
             "call it as a statement and read its outputs afterwards");
    return nullptr;
  }
  const syntax::Name& name = expression.name;
  const Variable* variable = find_variable(name.id);
  const bool own_result = pou_ != nullptr && pou_->kind == PouKind::Function && pou_->name == name.id;
  if (variable != nullptr && !own_result) {
    if (variable->type == nullptr) return nullptr;
    if (variable->type->kind == TypeKind::Instance) {
      a_.error(code::kNoResult, name.where, "the function block " + quote(name.text) + " has no result",
               "call it as a statement and read its outputs afterwards");
    } else {
      a_.error(code::kNotCallable, name.where, quote(name.text) + " is a variable and cannot be called");
    }
    return nullptr;
  }
  const auto pou = a_.pous.find(name.id.value);
  if (pou != a_.pous.end()) {
    if (pou->second->kind == PouKind::Function) return function_call(expression, *pou->second);
    a_.error(code::kNotCallable, name.where, quote(name.text) + " is no function",
             "declare an instance of it and call that");
    return nullptr;
  }
  const std::string& folded = a_.names.folded(name.id);
  bool known = false;
  ValuePtr result = StandardAnalyzer(a_, *this).call(expression, folded, known);
  if (known) return result;
  if (const auto conversion = named_conversion(folded)) return explicit_conversion(expression, *conversion);
  std::vector<std::string_view> candidates;
  StandardAnalyzer::add_names(candidates);
  for (const auto& each : a_.model.pous)
    if (each->kind == PouKind::Function) candidates.push_back(each->spelling);
  a_.error(code::kUndeclared, name.where, "there is no function " + quote(name.text),
           unknown_function_hint(folded, candidates));
  return nullptr;
}

// `out` holds, for each variable of the POU, its argument or null.
bool ExpressionAnalyzer::match_arguments(const Expression& call, const Pou& pou,
                                         std::vector<const Argument*>& out) {
  out.assign(pou.variables.size(), nullptr);
  std::vector<std::size_t> positional;
  std::vector<std::string_view> formals;
  for (std::size_t i = 0; i < pou.variables.size(); ++i) {
    if (!is_parameter(pou.variables[i])) continue;
    positional.push_back(i);
    formals.push_back(pou.variables[i].spelling);
  }
  std::size_t next = 0;
  bool sound = true;
  for (const Argument& each : call.arguments) {
    std::size_t index = 0;
    if (!each.formal) {
      if (next >= positional.size()) {
        a_.error(code::kArgumentCount, each.value->where,
                 quote(pou.spelling) + " takes " + std::to_string(positional.size()) + " arguments");
        return false;
      }
      index = positional[next++];
    } else {
      const auto known = pou.scope.find(each.formal->id.value);
      if (known == pou.scope.end() || !is_parameter(pou.variables[known->second])) {
        a_.error(code::kUnknownParameter, each.formal->where,
                 quote(pou.spelling) + " has no parameter " + quote(each.formal->text),
                 source::did_you_mean(each.formal->text, formals));
        sound = false;
        continue;
      }
      index = known->second;
      const bool is_output = pou.variables[index].section == Section::Output;
      if (is_output != each.is_output) {
        a_.error(code::kUnknownParameter, each.formal->where,
                 quote(each.formal->text) +
                     (is_output ? " is an output: write it with '=>'" : " is no output: write it with ':='"));
        sound = false;
        continue;
      }
    }
    if (out[index] != nullptr) {
      a_.error(code::kDuplicateArgument, each.formal ? each.formal->where : each.value->where,
               quote(pou.variables[index].spelling) + " is given twice");
      sound = false;
    }
    out[index] = &each;
  }
  return sound;
}

// `Q => y`: y := source, behind the call.
bool ExpressionAnalyzer::pass_output(const Argument& argument, Place source, std::vector<CopyAfter>& after) {
  if (!argument.value) return true;
  auto target = place(*argument.value, Access::Write);
  if (!target) return false;
  const Position where = argument.value->where;
  ValuePtr value = load(std::move(source), where);
  if (argument.negated) {
    if (!value->type->is_bool()) {
      a_.error(code::kBadOperand, where, "NOT cannot be applied to " + value->type->name);
      return false;
    }
    ValuePtr inverse = make(ValueKind::Unary, value->type, where);
    inverse->op = syntax::Operator::Not;
    inverse->operands.push_back(std::move(value));
    value = std::move(inverse);
  }
  value = convert(std::move(value), target->type, where);
  if (!value) return false;
  after.push_back({std::move(*target), std::move(value)});
  return true;
}

// The address of a VAR_IN_OUT argument. What has none (a bit, a local slot) goes through a copy.
ValuePtr ExpressionAnalyzer::reference_argument(const Argument& argument, const Variable& parameter,
                                                std::vector<CopyBefore>& before,
                                                std::vector<CopyAfter>& after) {
  if (!argument.value) return nullptr;
  const Position where = argument.value->where;
  auto target = place(*argument.value, Access::Write);
  if (!target) return nullptr;
  if (target->type != parameter.type) return mismatch(*target->type, *parameter.type, where);
  if (!target->is_addressable()) {
    const Place scratch = a_.allocate_place(parameter.type, where);
    before.push_back({copy_direct(scratch), load(copy_direct(*target), where)});
    after.push_back({std::move(*target), load(copy_direct(scratch), where)});
    target = copy_direct(scratch);
  }
  ValuePtr reference = make(ValueKind::Reference, parameter.type, where);
  reference->place = std::move(*target);
  return reference;
}

bool ExpressionAnalyzer::function_argument(const Variable& parameter, const Argument* argument,
                                           const Expression& call, Value& out) {
  if (parameter.type == nullptr) return false;
  if (parameter.section == Section::Output)
    return argument == nullptr || pass_output(*argument, copy_direct(parameter.place), out.after);
  ValuePtr value;
  if (parameter.section == Section::InOut || !parameter.type->is_scalar()) {
    if (argument == nullptr || !argument->value) {
      a_.error(code::kMissingInOut, call.where,
               "the call gives no variable for " + quote(parameter.spelling));
      return false;
    }
    if (parameter.section == Section::InOut) {
      value = reference_argument(*argument, parameter, out.before, out.after);
    } else if (auto source = place(*argument->value, Access::Read)) {
      if (source->type != parameter.type) {
        mismatch(*source->type, *parameter.type, argument->value->where);
        return false;
      }
      value = make(ValueKind::Reference, parameter.type, argument->value->where);
      value->place = std::move(*source);
    }
  } else if (argument != nullptr) {
    value = value_as(*argument->value, parameter.type);
  } else {
    value = make_constant(parameter.initial.value_or(Constant{}), parameter.type, call.where);
  }
  if (!value) return false;
  out.operands.push_back(std::move(value));
  return true;
}

ValuePtr ExpressionAnalyzer::function_call(const Expression& expression, Pou& function) {
  note_callee(function);
  std::vector<const Argument*> arguments;
  if (!match_arguments(expression, function, arguments)) return nullptr;
  if (function.result == nullptr) return nullptr;
  const bool has_required = std::any_of(function.variables.begin(), function.variables.end(),
                                        [](const Variable& v) { return v.section == Section::Input; });
  if (expression.arguments.empty() && has_required) {
    a_.error(code::kArgumentCount, expression.where,
             quote(function.spelling) + " is called without arguments");
    return nullptr;
  }
  ValuePtr result = make(ValueKind::Call, function.result, expression.where);
  result->pou = &function;
  bool sound = true;
  for (std::size_t i = 0; i < function.variables.size(); ++i) {
    const Variable& parameter = function.variables[i];
    if (!is_parameter(parameter)) continue;
    sound = function_argument(parameter, arguments[i], expression, *result) && sound;
  }
  return sound ? std::move(result) : nullptr;
}

std::optional<Statement> ExpressionAnalyzer::call_statement(const Expression& call) {
  if (!call.operands.empty()) return block_call(call, call.operands[0].get());
  const Variable* variable = find_variable(call.name.id);
  if (variable != nullptr && variable->type == nullptr) return std::nullopt;
  if (variable != nullptr && variable->type->kind == TypeKind::Instance) return block_call(call, nullptr);
  ValuePtr value = this->call(call);
  if (!value) return std::nullopt;
  Statement statement;
  statement.kind = StatementKind::Evaluate;
  statement.where = call.where;
  statement.value = std::move(value);
  return statement;
}

// A member of the instance that is called; the instance has no index on its way.
Place ExpressionAnalyzer::part_of_target(const Place& instance, const Variable& member) {
  Place part = copy_direct(instance);
  if (instance.is_direct()) {
    part.offset += member.place.offset;
  } else {
    PlaceStep step;
    step.offset = member.place.offset;
    part.steps.push_back(std::move(step));
  }
  part.type = member.type;
  return part;
}

bool ExpressionAnalyzer::block_argument(const Variable& parameter, const Argument& argument, Statement& out) {
  if (parameter.type == nullptr) return false;
  Place member = part_of_target(out.target, parameter);
  if (parameter.section == Section::Output) return pass_output(argument, std::move(member), out.after);
  if (!argument.value) return false;
  ValuePtr value;
  if (parameter.section == Section::InOut) {
    value = reference_argument(argument, parameter, out.before, out.after);
  } else {
    value = value_as(*argument.value, parameter.type);
  }
  if (!value) return false;
  out.before.push_back({std::move(member), std::move(value)});
  return true;
}

std::optional<Statement> ExpressionAnalyzer::block_call(const Expression& call, const Expression* path) {
  std::optional<Place> instance = path != nullptr ? place(*path, Access::Read) : variable_place(call.name);
  if (!instance) return std::nullopt;
  if (instance->type->kind != TypeKind::Instance) {
    a_.error(code::kNotCallable, call.where, instance->type->name + " cannot be called");
    return std::nullopt;
  }
  const Pou& block = *instance->type->pou;
  if (block.kind == PouKind::Program) {
    a_.error(code::kNotCallable, call.where, "a program cannot be called");
    return std::nullopt;
  }
  note_callee(block);
  std::vector<const Argument*> arguments;
  bool sound = match_arguments(call, block, arguments);
  Statement statement;
  statement.kind = StatementKind::Instance;
  statement.where = call.where;
  if (instance->is_direct()) {
    statement.target = std::move(*instance);
  } else {
    // The way to the instance is walked once; its address waits in a slot.
    pou_->slots.push_back(bytecode::StackType::Ref);
    Place slot;
    slot.base = Base::Slot;
    slot.slot = static_cast<std::uint32_t>(pou_->slots.size() - 1);
    slot.type = instance->type;
    statement.target.base = Base::SlotRef;
    statement.target.slot = slot.slot;
    statement.target.type = instance->type;
    ValuePtr address = make(ValueKind::Reference, instance->type, call.where);
    address->place = std::move(*instance);
    statement.before.push_back({std::move(slot), std::move(address)});
  }
  for (std::size_t i = 0; i < block.variables.size() && sound; ++i) {
    const Variable& parameter = block.variables[i];
    if (arguments[i] != nullptr) {
      sound = block_argument(parameter, *arguments[i], statement) && sound;
    } else if (parameter.section == Section::InOut) {
      a_.error(code::kMissingInOut, call.where,
               "the call gives no variable for " + quote(parameter.spelling));
      sound = false;
    }
  }
  return sound ? std::optional(std::move(statement)) : std::nullopt;
}

}  // namespace stepwright::semantics::internal
