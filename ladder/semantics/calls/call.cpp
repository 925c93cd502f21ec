// Calls of user functions and function blocks (IEC 61131-3, 6.6.1.7).

#include <algorithm>
#include <utility>

#include "ladder/semantics/calls/call_analyzer.h"
#include "ladder/semantics/calls/test_analyzer.h"
#include "ladder/semantics/standard_functions/standard_analyzer.h"
#include "ladder/source/suggestion.h"

namespace stepwright::semantics::internal {

using syntax::Argument;
using syntax::Expression;

namespace {

// A name like "INT_TO_REEL" is a conversion to a type that does not exist; else what the name is near to.
std::string unknown_function_hint(const std::string& folded,
                                  const std::vector<std::string_view>& candidates) {
  if (folded == "ADR")
    return source::with_dialects("REF(...) refers to a variable", &source::Dialect::pointers);
  const std::size_t middle = folded.rfind("TO_");
  if (middle == std::string::npos) return source::did_you_mean(folded, candidates);
  std::vector<std::string_view> types = {"STRING", "WSTRING"};
  for (std::uint8_t i = 0; i < bytecode::kScalarTypeCount; ++i)
    types.emplace_back(bytecode::name_of(static_cast<ElementaryType>(i)));
  std::string hint = source::did_you_mean(folded.substr(middle + 3), types);
  return hint.empty() ? source::did_you_mean(folded, candidates) : hint;
}

}  // namespace

void CallAnalyzer::note_callee(const Pou& callee) {
  if (pou_ != nullptr) pou_->note_callee(callee);
}

ValuePtr value_of_call(Analysis& analysis, ExpressionAnalyzer& expressions, Pou* pou,
                       const Expression& call) {
  return CallAnalyzer(analysis, expressions, pou).call(call);
}

ValuePtr CallAnalyzer::call(const Expression& expression) {
  ValuePtr result = callee(expression);
  return result ? enabled(std::move(result), expression) : nullptr;
}

ValuePtr CallAnalyzer::callee(const Expression& expression) {
  if (!expression.operands.empty()) {
    const Expression* root = expression.operands[0].get();
    while (!root->operands.empty()) root = root->operands[0].get();
    if (root->kind == syntax::ExpressionKind::Variable &&
        e_.places().find_variable(root->name.id) == nullptr) {
      e_.places().report_unknown(root->name);
      return nullptr;
    }
    a_.error(code::kNoResult, expression.where, "a function block has no result",
             "call it as a statement and read its outputs afterwards");
    return nullptr;
  }
  const syntax::Name& name = expression.name;
  const Variable* variable = e_.places().find_variable(name.id);
  const bool own_result = pou_ != nullptr && pou_->kind == PouKind::Function && pou_->name == name.id;
  if (variable != nullptr && !own_result) {
    if (variable->type == nullptr) return nullptr;
    if (variable->type->kind == TypeKind::Instance) {
      a_.error(code::kNoResult, name.where, "the function block " + quote(name.text) + " has no result",
               "call it as a statement and read its outputs afterwards");
    } else {
      a_.error(code::kNotCallable, name.where, quote(name.text) + " is a variable and cannot be called",
               Places::index_hint(name.text, *variable->type));
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
  if (folded == "REF" || (folded == "ADR" && a_.dialect->pointers)) return e_.reference_to(expression);
  if (folded == "LOWER_BOUND" || folded == "UPPER_BOUND") return e_.array_bound(expression, folded[0] == 'U');
  bool known = false;
  ValuePtr result = StandardAnalyzer(a_, e_).call(expression, folded, known);
  if (known) return result;
  if (const auto conversion = e_.explicit_conversions().named_conversion(folded)) {
    auto arguments = StandardAnalyzer(a_, e_).arguments(expression, "IN", 1);
    return arguments ? e_.explicit_conversions().apply(std::move(arguments->front()), *conversion, expression)
                     : nullptr;
  }
  if (is_test_statement(folded)) {
    if (e_.places().in_test()) {
      a_.error(code::kNoResult, name.where, quote(name.text) + " is a statement and has no result");
    } else {
      a_.error(code::kOnlyInTest, name.where, quote(name.text) + " stands in a TEST only",
               "move it into TEST '...' ... END_TEST, or name a function of your own so");
    }
    return nullptr;
  }
  if (a_.sink.is_full()) {
    a_.error(code::kUndeclared, name.where, {});
    return nullptr;
  }
  std::vector<std::string_view> candidates;
  StandardAnalyzer::add_names(candidates);
  for (const auto& each : a_.model.pous)
    if (each->kind == PouKind::Function) candidates.push_back(each->spelling);
  a_.unknown_name(code::kUndeclared, pou_, name.where, "there is no function " + quote(name.text),
                  unknown_function_hint(folded, candidates));
  return nullptr;
}

ValuePtr CallAnalyzer::function_call(const Expression& expression, Pou& function) {
  if (pou_ == nullptr) {
    a_.error(code::kNotConstant, expression.where, "the value must be known when the program is compiled");
    return nullptr;
  }
  note_callee(function);
  std::vector<const Argument*> arguments;
  if (!match_arguments(expression, function, arguments)) return nullptr;
  if (function.has_result && function.result == nullptr) return nullptr;
  const auto& variables = function.variables;
  const Type* type = function.has_result ? function.result : a_.type_table().nothing();
  if (type->kind == TypeKind::Subrange) type = type->base;
  ValuePtr result = make(ValueKind::Call, type, expression.where);
  result->pou = &function;
  bool sound = true;
  // In the order of the slots: see model.h.
  for (const bool outputs : {false, true}) {
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const Variable& each = variables[i];
      const bool is_input = each.section == Section::Input || each.section == Section::InOut;
      if (outputs ? each.section != Section::Output : !is_input) continue;
      if (each.type == nullptr) return nullptr;
      if (outputs) {
        sound = output_argument(each, arguments[i], expression, *result) && sound;
      } else if (each.section == Section::InOut || each.type->open) {
        sound = in_out_argument(each, arguments[i], expression, *result) && sound;
      } else {
        sound = input_argument(each, arguments[i], expression, *result) && sound;
      }
    }
  }
  if (!sound) return nullptr;
  if (function.has_result && !type->is_scalar()) {
    result->place = frame_place(*pou_, type);
    result->operands.push_back(address_of(copy_direct(result->place), expression.where));
  }
  return result;
}

std::optional<Statement> CallAnalyzer::call_statement(const Expression& call) {
  if (!call.operands.empty()) return block_call(call, call.operands[0].get());
  const Variable* variable = e_.places().find_variable(call.name.id);
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

std::optional<Statement> CallAnalyzer::block_call(const Expression& call, const Expression* path) {
  if (pou_ == nullptr) return std::nullopt;
  std::optional<Place> instance =
      path != nullptr ? e_.places().place(*path, Access::Read) : e_.places().variable_place(call.name);
  if (!instance) return std::nullopt;
  if (instance->type->kind != TypeKind::Instance) {
    a_.error(code::kNotCallable, call.where, instance->type->name + " cannot be called");
    return std::nullopt;
  }
  const Pou& block = *instance->type->pou;
  if (block.kind == PouKind::Program && !e_.places().in_test()) {
    a_.error(code::kNotCallable, call.where, "a program cannot be called");
    return std::nullopt;
  }
  note_callee(block);
  Statement statement;
  statement.kind = StatementKind::Instance;
  statement.where = call.where;
  if (path == nullptr) {
    const auto given = a_.run_by_tasks.find(pou_);
    statement.passes_only =
        given != a_.run_by_tasks.end() &&
        std::find(given->second.begin(), given->second.end(), call.name.id) != given->second.end();
  }
  if (instance->is_direct()) {
    statement.target = std::move(*instance);
  } else {
    // The way to the instance is walked once; its address waits in a slot.
    pou_->slots.push_back(bytecode::StackType::Ref);
    Place slot;
    slot.base = Base::Slot;
    slot.slot = static_cast<std::uint32_t>(pou_->slots.size() - 1);
    statement.target.base = Base::SlotRef;
    statement.target.slot = slot.slot;
    statement.target.type = instance->type;
    const Type* type = a_.type_table().reference(instance->type);
    slot.type = type;
    statement.before.push_back({std::move(slot), address_of(std::move(*instance), call.where)});
  }
  std::vector<const Argument*> arguments;
  const bool sound = match_arguments(call, block, arguments) && pass(arguments, block, call.where, statement);
  return sound ? std::optional(enabled_block(std::move(statement), call)) : std::nullopt;
}

// What a call of the block gives each of its parameters.
bool CallAnalyzer::pass(const std::vector<const Argument*>& arguments, const Pou& block, Position where,
                        Statement& out) {
  bool sound = true;
  for (std::size_t i = 0; i < block.variables.size() && sound; ++i) {
    const Variable& parameter = block.variables[i];
    if (arguments[i] != nullptr) {
      sound = block_argument(parameter, *arguments[i], out);
    } else if (parameter.section == Section::InOut) {
      a_.error(code::kMissingInOut, where, "the call gives no variable for " + quote(parameter.spelling));
      sound = false;
    }
  }
  return sound;
}

bool CallAnalyzer::pass_arguments(const std::vector<Argument>& given, const Pou& block, Position where,
                                  Statement& out) {
  std::vector<const Argument*> arguments;
  return match_given(given, block, arguments) && pass(arguments, block, where, out);
}

// A member of the instance that is called; the instance has no index on its way.
Place CallAnalyzer::part_of_target(const Place& instance, std::uint32_t offset, const Type* type) {
  Place part = copy_direct(instance);
  advance(part, offset);
  part.type = type;
  return part;
}

bool CallAnalyzer::block_argument(const Variable& parameter, const Argument& argument, Statement& out) {
  if (parameter.type == nullptr) return false;
  const std::uint32_t offset = parameter.place.offset;
  if (parameter.section == Section::Output)
    return pass_output(argument, part_of_target(out.target, offset, parameter.type), out.after,
                       parameter.any_integer);
  if (!argument.value) return false;
  if (parameter.section == Section::InOut) {
    ValuePtr address = reference_argument(argument, parameter, out.before, out.after);
    if (!address) return false;
    if (parameter.type->open) {
      auto bounds = bounds_of(address->place, argument.value->where);
      for (std::size_t i = 0; i < bounds.size(); ++i) {
        const Place& bound = parameter.bounds[i];
        out.before.push_back({part_of_target(out.target, bound.offset, bound.type), std::move(bounds[i])});
      }
    }
    Place member = part_of_target(out.target, offset, address->type);
    out.before.push_back({std::move(member), std::move(address)});
    return true;
  }
  ValuePtr value = input_value(parameter, *argument.value);
  if (!value) return false;
  out.before.push_back({part_of_target(out.target, offset, parameter.type), std::move(value)});
  return true;
}

}  // namespace stepwright::semantics::internal
