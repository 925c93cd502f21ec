#include "supervisor/pddl/task/goal_vocabulary.h"

#include "supervisor/pddl/definition/ast.h"

namespace stepwright::pddl {
namespace {

GoalSymbol describe(const Definition& definition, const Symbol& symbol, GoalVocabulary& words) {
  GoalSymbol described{symbol.name, {}, symbol.changes};
  for (const Typed& parameter : symbol.parameters) {
    const auto type = static_cast<std::size_t>(parameter.type);
    const std::string& name = definition.types[type].name;
    const bool marked = !parameter.name.empty() && parameter.name.front() == '?';
    described.parameters.push_back({marked ? parameter.name.substr(1) : parameter.name, name});
    const auto [place, fresh] = words.objects.try_emplace(name);
    if (!fresh) continue;
    for (const int object : definition.objects_by_type[type])
      place->second.push_back(definition.objects[static_cast<std::size_t>(object)].name);
  }
  return described;
}

}  // namespace

GoalVocabulary goal_vocabulary(const Task& task) {
  const Definition& definition = task.definition();
  GoalVocabulary words;
  for (const Symbol& symbol : definition.predicates) {
    if (symbol.changes || symbol.derived) words.predicates.push_back(describe(definition, symbol, words));
  }
  for (std::size_t i = 0; i < definition.functions.size(); ++i) {
    if (static_cast<int>(i) == definition.total_time) continue;
    words.functions.push_back(describe(definition, definition.functions[i], words));
  }
  return words;
}

std::string goal_text(const std::vector<std::string>& conjuncts) {
  if (conjuncts.size() == 1) return conjuncts.front();
  std::string text = "(and";
  for (const std::string& each : conjuncts) text += "\n  " + each;
  return text + ")";
}

}  // namespace stepwright::pddl
