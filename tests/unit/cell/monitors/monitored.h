#pragma once

// A program of a cell with the monitors of a text of its configuration.

#include <gtest/gtest.h>

#include <string>

#include "cell/monitors/cell_monitors.h"
#include "ladder/driver/compile.h"
#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::cell_monitors::test {

// With what is wrong with the text.
inline config::CellConfig cell_of(const std::string& toml, result::Diagnostics* problems = nullptr) {
  config::CellConfig config;
  auto document = settings::TomlDocument::parse(toml, "cell.toml");
  EXPECT_TRUE(document) << result::to_string(document.error());
  config.monitors = config::read_monitors((*document)->root(), {});
  const result::Diagnostics found = (*document)->finish();
  EXPECT_TRUE(problems != nullptr || found.empty()) << result::to_string(found);
  if (problems != nullptr) *problems = found;
  return config;
}

inline result::Result<std::vector<std::byte>> compiled_with(const config::CellConfig& config,
                                                            const std::string& program) {
  const auto monitors = cell_monitors(config);
  if (!monitors) return tl::unexpected(monitors.error());
  const auto watchers = watchers_of(*monitors);
  auto output = driver::compile({.texts = {{"main.st", program}}, .watchers = watchers});
  if (!output) return tl::unexpected(output.error());
  return std::move(output->container);
}

inline reader::LoadedProgram loaded_with(const std::string& toml, const std::string& program) {
  auto container = compiled_with(cell_of(toml), program);
  EXPECT_TRUE(container) << result::to_string(container.error());
  auto loaded = reader::LoadedProgram::load(*container, "test");
  EXPECT_TRUE(loaded) << result::to_string(loaded.error());
  return *std::move(loaded);
}

}  // namespace stepwright::cell_monitors::test
