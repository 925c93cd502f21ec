#pragma once

// A C text, compiled by gcc -O2 into a library and loaded.

#include <memory>
#include <string>

#include "tests/bench/engines/subject.h"

namespace stepwright::bench {

// Throws std::runtime_error if there is no gcc or it does not like the text. `results`: how many there are.
std::unique_ptr<Subject> compile_c(const std::string& text, std::size_t results);

}  // namespace stepwright::bench
