// Names that other systems write with a dot where the standard has '#' or nothing (Dialect): Color.Red is
// Color#Red, List.x the global x.

#include <algorithm>

#include "ladder/semantics/expressions/expression_analyzer.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::semantics::internal {

using source::Dialect;
using syntax::Expression;
using syntax::ExpressionKind;

namespace {

// "dir/Motors.st" -> "Motors"
std::string_view stem(std::string_view path) {
  path.remove_prefix(path.rfind('/') == std::string_view::npos ? 0 : path.rfind('/') + 1);
  return path.substr(0, path.find('.'));
}

}  // namespace

// `known`: the name before the dot is an enumeration.
ValuePtr ExpressionAnalyzer::dotted_enumerator(const Expression& expression, bool& known) {
  known = false;
  const Expression& base = *expression.operands[0];
  if (base.kind != ExpressionKind::Variable || places_.find_variable(base.name.id) != nullptr) return nullptr;
  const auto type = a_.types.find(base.name.id.value);
  if (type == a_.types.end() || type->second == nullptr || type->second->kind != TypeKind::Enumeration)
    return nullptr;
  known = true;
  const syntax::Name& name = expression.name;
  const Enumerator* found = type->second->find_enumerator(name.id);
  if (found == nullptr) {
    a_.unknown_name(code::kUnknownMember, pou_, name.where,
                    quote(type->second->name) + " has no value " + quote(name.text));
    return nullptr;
  }
  if (a_.dialect->dotted_enumerators) return make_constant({found->value}, type->second, expression.where);
  a_.error(code::kNotAVariable, base.name.where, quote(base.name.text) + " is a type, not a variable",
           source::with_dialects(
               "write " + std::string(base.name.text) + "#" + std::string(name.text) + " for its value",
               &Dialect::dotted_enumerators));
  return nullptr;
}

// The name of a configuration, a resource, or of the file that declares the global.
bool Places::is_list_of(const Variable& global, const syntax::Name& list) const {
  return a_.list_names.contains(list.id.value) ||
         naming::same_name(stem(a_.sink.sources().name(global.where.file)), list.text);
}

const Variable* Places::qualified_global(const Expression& expression) {
  const Expression& base = *expression.operands[0];
  if (base.kind != ExpressionKind::Variable || find_variable(base.name.id) != nullptr) return nullptr;
  const auto global = a_.globals.find(expression.name.id.value);
  if (global == a_.globals.end()) return nullptr;
  const Variable& found = a_.model.globals[global->second];
  if (!is_list_of(found, base.name)) return nullptr;
  if (a_.dialect->qualified_globals) return &found;
  a_.unknown_name(
      code::kUndeclared, pou_, base.name.where, quote(base.name.text) + " is not declared",
      source::with_dialects("write " + std::string(expression.name.text) + " for the global variable",
                            &Dialect::qualified_globals));
  return nullptr;
}

}  // namespace stepwright::semantics::internal
