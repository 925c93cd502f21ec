#pragma once

// A language test: an ST program whose comments say what must come out when it runs (tests/st/directive.h).
// It runs on every engine of this machine; all must agree in the image and in the traps of each scan.

#include <string>
#include <vector>

#include "tests/st/directive.h"

namespace stepwright::st_test {

// Compiles and runs the program; every check that fails as one line "file:line: ...". Empty = passed.
std::vector<std::string> run_checks(const std::string& name, const std::string& text);

// The file names below `root`, relative to it, in order.
std::vector<std::string> programs_below(const std::string& root);

std::string read_file(const std::string& path);

}  // namespace stepwright::st_test
