#pragma once

// [tasks.NAME]: what a cell's configuration says of a task of its program.
//
//   [tasks.fast]
//   phase_us = 500          # after the start and within each interval
//   overrun = "catch_up"    # "skip" (default), "catch_up", "fault"
//   cpu = 1                 # the only processor of its thread; [runtime] cpu is that of all

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/ground/settings/toml_document.h"

namespace stepwright::config {

enum class OverrunAction : std::uint8_t { Skip, CatchUp, Fault };

struct TaskConfig {
  std::string name;  // as the program declares it, in any case
  std::int64_t phase_us = 0;
  OverrunAction overrun = OverrunAction::Skip;
  int cpu = -1;  // -1: that of [runtime]
  result::Location where = {};
};

// A processor of this machine, or -1 where the key is missing; one that is not there is reported.
int read_cpu(const settings::TomlTable& table);

// The tables below [tasks].
std::vector<TaskConfig> read_tasks(const settings::TomlTable& root);

}  // namespace stepwright::config
