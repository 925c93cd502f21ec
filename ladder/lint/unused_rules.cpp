// What is declared and not used, or used and never given a value.

#include <algorithm>

#include "ladder/lint/internal/rules.h"
#include "ladder/source/codes.h"
#include "ladder/source/name_table.h"

namespace stepwright::lint::internal {

namespace code = source::code;
using semantics::Pou;
using semantics::PouKind;
using semantics::Section;
using semantics::Type;
using semantics::TypeKind;

namespace {

bool is_parameter(const semantics::Variable& variable) {
  return variable.section == Section::Input || variable.section == Section::Output ||
         variable.section == Section::InOut;
}

bool has_body(const Pou& pou) {
  return !pou.declaration->body.empty();
}

bool is_located(const semantics::Variable& variable) {
  return variable.address || variable.open_address;
}

// Function blocks have values of their own.
bool holds_instance(const Type& type) {
  if (type.kind == TypeKind::Instance) return true;
  return type.element != nullptr && type.kind == TypeKind::Array && holds_instance(*type.element);
}

// An action's indicators are for people; to name one is to use it.
void name_indicators(Uses& uses) {
  for (std::size_t i = 0; i < uses.user_pous; ++i) {
    const auto& chart = uses.model.pous[i]->declaration->chart;
    if (!chart) continue;
    std::unordered_map<std::string, std::size_t> variables;
    for (std::size_t v = 0; v < uses.of_pous[i].size(); ++v)
      variables.try_emplace(source::upper(uses.of_pous[i][v].variable->spelling), v);
    for (const syntax::StepDeclaration& step : chart->steps)
      for (const syntax::ActionUse& action : step.actions)
        for (const syntax::TextSlice& each : action.indicators)
          if (const auto named = variables.find(source::upper(each.text)); named != variables.end())
            uses.of_pous[i][named->second].named = true;
  }
}

void check_variable(const VariableUse& use, const Pou& pou, source::DiagnosticSink& sink) {
  const semantics::Variable& variable = *use.variable;
  // The result of a function is a variable of its name; EN and ENO are there for the caller.
  if (use.named || use.generated || variable.name == pou.name || variable.type == nullptr) return;
  if (is_located(variable) || variable.spelling.substr(0, 2) == "__") return;
  if (!is_parameter(variable)) {
    sink.warning(code::kUnusedVariable, variable.where, quote(variable.spelling) + " is never used");
    return;
  }
  const bool enables =
      naming::same_name(variable.spelling, "EN") || naming::same_name(variable.spelling, "ENO");
  if (!has_body(pou) || enables || variable.section == Section::Output) return;
  sink.warning(code::kUnusedParameter, variable.where,
               "the parameter " + quote(variable.spelling) + " is never used");
}

void check_value(const VariableUse& use, const Pou& pou, source::DiagnosticSink& sink) {
  const semantics::Variable& variable = *use.variable;
  if (use.writes > 0 || use.referred || use.initialised || use.generated || variable.type == nullptr) return;
  if (variable.constant || is_located(variable) || holds_instance(*variable.type)) return;
  if (!variable.type->initial.empty() && !variable.type->is_string()) return;
  if (variable.section == Section::Output) {
    const bool enables = naming::same_name(variable.spelling, "ENO");
    if (has_body(pou) && !enables)
      sink.warning(code::kNeverWritten, variable.where,
                   "the output " + quote(variable.spelling) + " is never written");
    return;
  }
  if (variable.name == pou.name) {
    if (has_body(pou))
      sink.warning(code::kNeverWritten, variable.where,
                   "the function " + quote(variable.spelling) + " never gives itself a result",
                   "write " + variable.spelling + " := ...;");
    return;
  }
  if (use.reads == 0 || (variable.section != Section::Local && variable.section != Section::Temp)) return;
  sink.warning(code::kNeverWritten, use.first_read,
               quote(variable.spelling) + " is read, but nothing writes it",
               "give it a first value where it is declared, or make it VAR_INPUT or CONSTANT");
}

}  // namespace

void check_unused(Uses& uses, source::DiagnosticSink& sink) {
  name_indicators(uses);
  for (std::size_t i = 0; i < uses.user_pous; ++i)
    for (const VariableUse& each : uses.of_pous[i]) check_variable(each, *uses.model.pous[i], sink);
  for (const VariableUse& each : uses.of_globals) {
    const semantics::Variable& variable = *each.variable;
    if (!each.named && !is_located(variable) && !variable.constant)
      sink.warning(code::kUnusedVariable, variable.where,
                   "the global variable " + quote(variable.spelling) + " is never used");
  }
}

void check_never_written(const Uses& uses, source::DiagnosticSink& sink) {
  for (std::size_t i = 0; i < uses.user_pous; ++i)
    for (const VariableUse& each : uses.of_pous[i]) check_value(each, *uses.model.pous[i], sink);
}

void check_unused_pous(const Uses& uses, const Reached& reached, source::DiagnosticSink& sink) {
  for (std::size_t i = 0; i < uses.user_pous; ++i) {
    const Pou& pou = *uses.model.pous[i];
    if (!reached.by.contains(&pou))
      sink.warning(code::kUnusedPou, pou.where, "no program that runs uses " + quote(pou.spelling));
  }
}

void check_dropped(const Uses& uses, source::DiagnosticSink& sink) {
  for (const auto& [where, callee] : uses.dropped) {
    // A function that also writes elsewhere may be called for that.
    const bool gives_more =
        std::any_of(callee->variables.begin(), callee->variables.end(), [](const semantics::Variable& each) {
          return each.section == Section::Output || each.section == Section::InOut;
        });
    const auto index = uses.pou_index.find(callee->name.value);
    if (gives_more || (index != uses.pou_index.end() && uses.has_side_effects[index->second])) continue;
    sink.warning(code::kUnusedResult, where, "the result of " + quote(callee->spelling) + " is not used");
  }
}

}  // namespace stepwright::lint::internal
