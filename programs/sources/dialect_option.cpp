#include "programs/sources/dialect_option.h"

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace stepwright::sources {

void add_dialect_option(CLI::App& app, const source::Dialect*& dialect) {
  std::vector<std::string> names;
  for (const source::Dialect& each : source::dialects()) names.emplace_back(each.name);
  app.add_option_function<std::string>(
         "--dialect", [&dialect](const std::string& name) { dialect = source::find_dialect(name); },
         "what the sources may write beside the standard (default standard)")
      ->check(CLI::IsMember(names));
}

}  // namespace stepwright::sources
