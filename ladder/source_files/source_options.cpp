#include "ladder/source_files/source_options.h"

#include <CLI/CLI.hpp>
#include <vector>

namespace stepwright::sources {

void add_source_options(CLI::App& app, SourceOptions& options) {
  std::vector<std::string> names;
  for (const source::Dialect& each : source::dialects()) names.emplace_back(each.name);
  app.add_option_function<std::string>(
         "--dialect", [&options](const std::string& name) { options.dialect = source::find_dialect(name); },
         "what the sources may write beside the standard (default standard)")
      ->check(CLI::IsMember(names));
  app.add_option("--configuration", options.configuration,
                 "which configuration (device) of a PLCopen file runs, if it has several");
}

}  // namespace stepwright::sources
