// The arguments of calls of user functions and function blocks (IEC 61131-3, 6.6.1.4).

#include <algorithm>
#include <utility>

#include "ladder/semantics/calls/call_analyzer.h"
#include "ladder/semantics/standard_functions/standard_analyzer.h"
#include "ladder/source/suggestion.h"

namespace stepwright::semantics::internal {

using syntax::Argument;
using syntax::Expression;

namespace {

bool is_enable_parameter(const source::NameTable& names, const Variable& variable) {
  const std::string& name = names.folded(variable.name);
  return name == "EN" || name == "ENO";
}

bool is_parameter(const Variable& variable) {
  return variable.section == Section::Input || variable.section == Section::Output ||
         variable.section == Section::InOut;
}

// A mistake in the declaration of a parameter, which was reported, took its name.
bool has_lost_parameter(const Pou& pou) {
  return std::ranges::any_of(pou.declaration->variables, [](const syntax::VariableDeclaration& line) {
    const bool parameter =
        line.section == Section::Input || line.section == Section::Output || line.section == Section::InOut;
    return parameter && line.names.empty();
  });
}

}  // namespace

// `out` holds, for each variable of the POU, its argument or null.
bool CallAnalyzer::match_arguments(const Expression& call, const Pou& pou,
                                   std::vector<const Argument*>& out) {
  out.assign(pou.variables.size(), nullptr);
  // EN and ENO are parameters like others where the POU declares them.
  for (const Argument* each : {call.enable.get(), call.enabled.get()}) {
    if (each == nullptr) continue;
    const auto known = pou.scope.find(each->formal->id.value);
    if (known != pou.scope.end() && is_parameter(pou.variables[known->second])) out[known->second] = each;
  }
  return match_given(call.arguments, pou, out);
}

bool CallAnalyzer::match_given(const std::vector<Argument>& given, const Pou& pou,
                               std::vector<const Argument*>& out) {
  out.resize(pou.variables.size(), nullptr);
  std::vector<std::size_t> positional;
  std::vector<std::string_view> formals;
  for (std::size_t i = 0; i < pou.variables.size(); ++i) {
    if (!is_parameter(pou.variables[i])) continue;
    // EN and ENO have no place in a list without names (6.6.1.4.2).
    const bool is_enable = is_enable_parameter(a_.names, pou.variables[i]);
    if (!is_enable) positional.push_back(i);
    formals.push_back(pou.variables[i].spelling);
  }
  std::size_t next = 0;
  bool sound = true;
  for (const Argument& each : given) {
    std::size_t index = 0;
    if (!each.formal) {
      if (next >= positional.size()) {
        if (!has_lost_parameter(pou))
          a_.error(code::kArgumentCount, each.value->where,
                   quote(pou.spelling) + " takes " + std::to_string(positional.size()) + " arguments");
        return false;
      }
      index = positional[next++];
    } else {
      const auto known = pou.scope.find(each.formal->id.value);
      if (known == pou.scope.end() || !is_parameter(pou.variables[known->second])) {
        a_.unknown_name(code::kUnknownParameter, pou_, each.formal->where,
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
bool CallAnalyzer::pass_output(const Argument& argument, Place source, std::vector<CopyAfter>& after,
                               bool any_integer) {
  if (!argument.value) return true;
  auto target = e_.places().place(*argument.value, Access::Write);
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
  if (any_integer) value = within_type(std::move(value), *target->type);
  value = e_.conversions().convert(std::move(value), target->type, where);
  if (!value) return false;
  after.push_back({std::move(*target), std::move(value)});
  return true;
}

// The value of an ANY_INT output, a LINT, in the integer type that it goes to; it traps if that does not hold
// it.
ValuePtr CallAnalyzer::within_type(ValuePtr integer, const Type& target) {
  const Type& to = target.kind == TypeKind::Subrange ? *target.base : target;
  if (!to.is_integer() || widens(*integer->type, to)) return integer;
  const Position where = integer->where;
  const IntegerRange held = range_of(integer->type->elementary);
  const IntegerRange wanted = range_of(to.elementary);
  const IntegerRange both{std::max(held.low, wanted.low), std::min(held.high, wanted.high)};
  ValuePtr checked = make(ValueKind::Check, a_.type_table().subrange(integer->type, both), where);
  checked->operands.push_back(std::move(integer));
  return convert_exactly(std::move(checked), &to);
}

// The value of an input. ANY_INT takes a ULINT too: what a LINT does not hold is as good as the largest,
// which is outside of every domain.
ValuePtr CallAnalyzer::input_value(const Variable& parameter, const Expression& given) {
  ValuePtr found = e_.value(given);
  if (!found) return nullptr;
  if (parameter.any_integer && found->type->is(ElementaryType::Ulint)) {
    const IntegerRange held = range_of(ElementaryType::Lint);
    found = StandardAnalyzer(a_, e_).bounded(std::move(found), 0, held.high);
    return convert_exactly(std::move(found), parameter.type);
  }
  return e_.conversions().convert(std::move(found), parameter.type, given.where);
}

// The address of a VAR_IN_OUT argument. What has none (a bit, a local slot) goes through a copy.
ValuePtr CallAnalyzer::reference_argument(const Argument& argument, const Variable& parameter,
                                          std::vector<CopyBefore>& before, std::vector<CopyAfter>& after) {
  if (!argument.value) return nullptr;
  const Position where = argument.value->where;
  auto target = e_.places().place(*argument.value, Access::Write);
  if (!target) return nullptr;
  if (!matches_parameter(*target->type, *parameter.type)) {
    if (!is_too_long(*target->type, *parameter.type))
      return e_.conversions().mismatch(*target->type, *parameter.type, where);
    a_.error(code::kTypeMismatch, where,
             target->type->name + " is too long to stand for " + quote(parameter.spelling) +
                 ": the length of a " + parameter.type->name + " is an INT",
             "declare " + quote(parameter.spelling) + " as " + plain_name(*parameter.type) +
                 "[32768] or longer; it takes strings of every length then, and its LEN is a DINT");
    return nullptr;
  }
  if (target->character) {
    a_.error(code::kNeedsVariable, where, "a character of a string has no address",
             "copy it into a variable and back");
    return nullptr;
  }
  if (!target->is_addressable()) {
    const Place scratch = frame_place(*pou_, parameter.type);
    before.push_back({copy_direct(scratch), load(copy_direct(*target), where)});
    after.push_back({std::move(*target), load(copy_direct(scratch), where)});
    target = copy_direct(scratch);
  }
  return address_of(std::move(*target), where);
}

ValuePtr CallAnalyzer::address_of(Place place, Position where) {
  ValuePtr address = make(ValueKind::Reference, a_.type_table().reference(place.type), where);
  address->place = std::move(place);
  return address;
}

// The length of a short string is INT: a long one cannot stand for it.
bool CallAnalyzer::is_too_long(const Type& argument, const Type& parameter) {
  constexpr std::uint32_t kMostOfInt = 0x7FFF;
  return argument.is_string() && parameter.is_string() && argument.elementary == parameter.elementary &&
         argument.capacity > kMostOfInt && parameter.capacity <= kMostOfInt;
}

// A variable-length array takes every array of its elements and number of dimensions; a string of any
// capacity carries it along.
bool CallAnalyzer::matches_parameter(const Type& argument, const Type& parameter) const {
  if (&argument == &parameter) return true;
  if (parameter.is_string())
    return argument.is_string() && argument.elementary == parameter.elementary &&
           !is_too_long(argument, parameter);
  return parameter.open && argument.kind == TypeKind::Array && argument.element == parameter.element &&
         argument.dimensions.size() == parameter.dimensions.size();
}

// The bounds of an array that is passed to a variable-length one: lower and upper of each dimension.
std::vector<ValuePtr> CallAnalyzer::bounds_of(const Place& array, Position where) {
  std::vector<ValuePtr> values;
  const Type* dint = a_.type_table().elementary(ElementaryType::Dint);
  for (std::size_t i = 0; i < array.type->dimensions.size(); ++i) {
    for (const bool upper : {false, true}) {
      const Dimension& fixed = array.type->dimensions[i];
      values.push_back(array.open != nullptr
                           ? load(copy_direct(array.open->bounds[2 * i + (upper ? 1 : 0)]), where)
                           : make_constant({upper ? fixed.upper : fixed.lower}, dint, where));
    }
  }
  return values;
}

bool CallAnalyzer::in_out_argument(const Variable& parameter, const Argument* argument,
                                   const Expression& call, Value& out) {
  if (argument == nullptr || !argument->value) {
    a_.error(code::kMissingInOut, call.where, "the call gives no variable for " + quote(parameter.spelling));
    return false;
  }
  ValuePtr address;
  if (parameter.section == Section::InOut) {
    address = reference_argument(*argument, parameter, out.before, out.after);
  } else if (auto source = e_.places().place(*argument->value, Access::Read)) {
    if (!matches_parameter(*source->type, *parameter.type)) {
      e_.conversions().mismatch(*source->type, *parameter.type, argument->value->where);
      return false;
    }
    address = address_of(std::move(*source), argument->value->where);
  }
  if (!address) return false;
  std::vector<ValuePtr> bounds;
  if (parameter.type->open) bounds = bounds_of(address->place, call.where);
  out.operands.push_back(std::move(address));
  for (ValuePtr& each : bounds) out.operands.push_back(std::move(each));
  return true;
}

// An input: its value, or the address of one that is in memory.
bool CallAnalyzer::input_argument(const Variable& parameter, const Argument* argument, const Expression& call,
                                  Value& out) {
  ValuePtr value;
  if (argument != nullptr && argument->value) {
    value = input_value(parameter, *argument->value);
  } else if (parameter.type->is_scalar()) {
    value = e_.first_value(parameter.initial.value_or(Constant{}), parameter.type, call.where);
  } else {
    value = load(copy_direct(parameter.first), call.where);
  }
  if (!value) return false;
  out.operands.push_back(std::move(value));
  return true;
}

// An output is written into the frame of the caller, which passes it on.
bool CallAnalyzer::output_argument(const Variable& parameter, const Argument* argument,
                                   const Expression& call, Value& out) {
  const Place left = frame_place(*pou_, parameter.type);
  out.operands.push_back(address_of(copy_direct(left), call.where));
  return argument == nullptr || pass_output(*argument, copy_direct(left), out.after, parameter.any_integer);
}

}  // namespace stepwright::semantics::internal
