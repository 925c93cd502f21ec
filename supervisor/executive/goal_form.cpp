#include "supervisor/executive/goal_form.h"

#include <set>
#include <string_view>
#include <utility>

#include "supervisor/pddl/task/goal_vocabulary.h"
#include "supervisor/run/internal/record_json.h"

namespace stepwright::executive {
namespace {

using run::internal::json;

json symbols_json(const std::vector<pddl::GoalSymbol>& symbols) {
  json list = json::array();
  for (const pddl::GoalSymbol& symbol : symbols) {
    json parameters = json::array();
    for (const pddl::GoalParameter& parameter : symbol.parameters)
      parameters.push_back({{"name", parameter.name}, {"type", parameter.type}});
    list.push_back(
        {{"name", symbol.name}, {"parameters", std::move(parameters)}, {"changes", symbol.changes}});
  }
  return list;
}

json sensors_json(const translate::Binding& binding) {
  json list = json::array();
  for (const translate::Sensor& sensor : binding.sensors) {
    json entry = {{"fluent", sensor.fluent},
                  {"label", sensor.label},
                  {"unit", sensor.unit},
                  {"step", sensor.resolution},
                  {"tolerance", sensor.tolerance}};
    if (sensor.range) entry["range"] = {sensor.range->first, sensor.range->second};
    list.push_back(std::move(entry));
  }
  return list;
}

json labels_json(const translate::Binding& binding) {
  json labels = json::object();
  for (const translate::ObservedFact& fact : binding.facts) labels[fact.fact] = fact.label;
  return labels;
}

// "(is-at v1 f1)" -> "is-at"
std::string_view symbol_of(std::string_view atom) {
  atom.remove_prefix(1);
  return atom.substr(0, atom.find_first_of(" )"));
}

std::string bounded(const json& document, const json& otherwise) {
  std::string text = run::internal::text_of(document);
  return text.size() <= kMaxGoalFormBytes ? text : run::internal::text_of(otherwise);
}

}  // namespace

std::string goal_form_json(const PlanningService& planning) {
  const pddl::GoalVocabulary words = pddl::goal_vocabulary(planning.task());
  const json form = {{"available", true},
                     {"domain", planning.task().domain_name()},
                     {"metric", planning.task().metric()},
                     {"objects", words.objects},
                     {"predicates", symbols_json(words.predicates)},
                     {"functions", symbols_json(words.functions)},
                     {"sensors", sensors_json(planning.binding())},
                     {"labels", labels_json(planning.binding())}};
  return bounded(form,
                 {{"available", false}, {"reason", "the problem has more objects than a form can offer"}});
}

OutlookWriter::OutlookWriter(const PlanningService& planning) : planning_(planning) {
  for (const pddl::GoalSymbol& symbol : pddl::goal_vocabulary(planning.task()).predicates)
    predicates_.insert(symbol.name);
}

std::string OutlookWriter::json(const Outlook& outlook, const std::string& what_if) {
  if (goal_ != outlook.goal) {
    goal_ = outlook.goal;
    goal_text_ = planning_.goal_text(outlook.goal);
  }
  run::internal::json facts = run::internal::json::array();
  for (const std::string& fact : outlook.state.facts) {
    if (predicates_.contains(symbol_of(fact))) facts.push_back(fact);
  }
  run::internal::json state = {{"facts", std::move(facts)}, {"fluents", outlook.state.fluents}};
  if (run::internal::text_of(state).size() > kMaxStateBytes) state = run::internal::json::object();
  state["goal"] = goal_text_;
  state["what_if"] = run::internal::json::parse(what_if, nullptr, false);
  return run::internal::text_of(state);
}

}  // namespace stepwright::executive
