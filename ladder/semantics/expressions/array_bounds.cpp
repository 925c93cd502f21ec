// LOWER_BOUND and UPPER_BOUND (IEC 61131-3, 6.4.4.5.3): the bounds of any array, as DINT.

#include "ladder/semantics/expressions/expression_analyzer.h"

namespace stepwright::semantics::internal {

using syntax::Expression;

ValuePtr ExpressionAnalyzer::array_bound(const Expression& call, bool upper) {
  const auto operands = plain_arguments(call, {"ARR", "DIM"}, 2);
  if (!operands) return nullptr;
  const auto array = places_.place(*(*operands)[0], Access::Read);
  const auto dimension = constant_integer(*(*operands)[1]);
  if (!array || !dimension) return nullptr;
  if (array->type->kind != TypeKind::Array) {
    a_.error(code::kTypeMismatch, (*operands)[0]->where, "an array is needed here, not " + array->type->name);
    return nullptr;
  }
  const auto& dimensions = array->type->dimensions;
  if (*dimension < 1 || *dimension > static_cast<std::int64_t>(dimensions.size())) {
    a_.error(code::kIndexCount, (*operands)[1]->where,
             "the array has " + std::to_string(dimensions.size()) + " dimensions, counted from 1");
    return nullptr;
  }
  const auto which = static_cast<std::size_t>(*dimension - 1);
  const Type* dint = a_.type_table().elementary(ElementaryType::Dint);
  if (array->open != nullptr)
    return load(copy_direct(array->open->bounds[2 * which + (upper ? 1 : 0)]), call.where);
  return make_constant({upper ? dimensions[which].upper : dimensions[which].lower}, dint, call.where);
}

// The arguments of a call that are no values, in the order of `formals`; nothing after a report.
std::optional<std::vector<const Expression*>> ExpressionAnalyzer::plain_arguments(
    const Expression& call, std::initializer_list<const char*> formals, std::size_t count) {
  std::vector<const Expression*> found(count, nullptr);
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    const syntax::Argument& argument = call.arguments[i];
    std::size_t target = i;
    if (argument.formal) {
      target = 0;
      for (const char* formal : formals) {
        if (a_.names.folded(argument.formal->id) == formal) break;
        ++target;
      }
    }
    if (target >= count || argument.is_output || !argument.value || found[target] != nullptr) {
      const Position where = argument.formal ? argument.formal->where : call.where;
      a_.error(argument.formal ? code::kUnknownParameter : code::kArgumentCount, where,
               quote(call.name.text) + " takes " + std::to_string(count) + " arguments");
      return std::nullopt;
    }
    found[target] = argument.value.get();
  }
  for (const Expression* each : found) {
    if (each != nullptr) continue;
    a_.error(code::kArgumentCount, call.where,
             quote(call.name.text) + " takes " + std::to_string(count) + " arguments");
    return std::nullopt;
  }
  return found;
}

}  // namespace stepwright::semantics::internal
