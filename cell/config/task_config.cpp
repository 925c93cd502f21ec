#include "cell/config/task_config.h"

#include <unistd.h>

namespace stepwright::config {

int read_cpu(const settings::TomlTable& table) {
  if (!table.has("cpu")) return -1;
  const auto highest = static_cast<double>(sysconf(_SC_NPROCESSORS_CONF) - 1);
  return static_cast<int>(table.integer("cpu", -1, {0.0, highest}));
}

std::vector<TaskConfig> read_tasks(const settings::TomlTable& root) {
  std::vector<TaskConfig> tasks;
  const settings::TomlTable tables = root.table("tasks");
  for (const std::string& name : tables.keys()) {
    const settings::TomlTable table = tables.table(name);
    TaskConfig task;
    task.name = name;
    task.where = table.where();
    task.phase_us = table.integer("phase_us", 0, {0, 3'600'000'000.0});
    const std::string overrun = table.choice("overrun", "skip", {"skip", "catch_up", "fault"});
    task.overrun = overrun == "fault"      ? OverrunAction::Fault
                   : overrun == "catch_up" ? OverrunAction::CatchUp
                                           : OverrunAction::Skip;
    task.cpu = read_cpu(table);
    tasks.push_back(std::move(task));
  }
  return tasks;
}

}  // namespace stepwright::config
