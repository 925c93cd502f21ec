#pragma once

// The option --dialect of the commands that read sources.

#include "ladder/source/dialect.h"

namespace CLI {
class App;
}

namespace stepwright::sources {

// Sets `dialect`, which must outlive the app, to the one that is named.
void add_dialect_option(CLI::App& app, const source::Dialect*& dialect);

}  // namespace stepwright::sources
