#include "supervisor/pddl/task/vocabulary.h"

#include "supervisor/pddl/definition/ast.h"

namespace stepwright::pddl {

model::Vocabulary vocabulary(const Task& task) {
  const Definition& definition = task.definition();
  model::Vocabulary names;
  for (const Action& action : definition.actions)
    names.actions.push_back({action.name, action.parameters.size()});
  for (const Symbol& symbol : definition.predicates) {
    names.predicates.push_back({symbol.name, symbol.parameters.size()});
  }
  for (const Symbol& symbol : definition.functions) {
    names.functions.push_back({symbol.name, symbol.parameters.size()});
  }
  for (const Object& object : definition.objects) names.objects.push_back(object.name);
  return names;
}

}  // namespace stepwright::pddl
