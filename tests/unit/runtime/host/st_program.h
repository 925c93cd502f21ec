#pragma once

// ST source as a container.

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "ladder/driver/compile.h"

namespace stepwright::host {

// Throws std::runtime_error with the diagnostics if the source is wrong.
inline std::vector<std::byte> compiled(const std::string& source) {
  driver::CompileInput input;
  input.texts.push_back({"test.st", source});
  auto output = driver::compile(input);
  if (!output) throw std::runtime_error(result::to_string(output.error()));
  return std::move(output->container);
}

}  // namespace stepwright::host
