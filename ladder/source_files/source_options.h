#pragma once

// The options of the commands that read sources: --dialect and --configuration.

#include <string>

#include "ladder/source/dialect.h"

namespace CLI {
class App;
}

namespace stepwright::sources {

struct SourceOptions {
  // Extensions of the standard that the sources may use.
  const source::Dialect* dialect = &source::standard_dialect();
  std::string configuration{};  // of those that a PLCopen file has; empty: it has one
};

// Sets `options`, which must outlive the app, to what is named.
void add_source_options(CLI::App& app, SourceOptions& options);

}  // namespace stepwright::sources
