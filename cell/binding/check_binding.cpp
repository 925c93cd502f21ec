#include "cell/binding/check_binding.h"

#include "cell/missions/planning/table/planning_table.h"
#include "supervisor/pddl/task/vocabulary.h"

namespace stepwright::cell_binding {

result::Diagnostics check_binding(const config::CellConfig& config) {
  const auto* const table = missions::table_as<missions::PlanningTable>(config.mission.table);
  if (table == nullptr) return {};
  const auto task = pddl::load_task(table->domain.string(), table->problem.string());
  if (!task) return {};
  const model::Vocabulary vocabulary = pddl::vocabulary(*task);
  const auto binding = translate::load_binding(table->binding, &vocabulary);
  if (!binding) return {};
  result::Diagnostics problems = check_actions(*task, *binding);
  for (result::Diagnostic& each : check_terminals(config, *binding)) problems.push_back(std::move(each));
  return problems;
}

}  // namespace stepwright::cell_binding
