#pragma once

// Programs for the instructions that decide where the program goes on: jumps, calls, returns.

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/bytecode/writer/container_model.h"

namespace stepwright::native {

struct ControlCase {
  std::string name;
  writer::ContainerModel model;             // runs its first program call
  std::vector<std::uint32_t> inputs = {0};  // written to the start of the memory, one for each run
};

std::vector<ControlCase> control_cases();

}  // namespace stepwright::native
