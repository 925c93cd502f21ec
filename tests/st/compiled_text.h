#pragma once

// One text of ST as a loaded program.

#include <string>

#include "ladder/source/dialect.h"
#include "runtime/bytecode/reader/loaded_program.h"

namespace stepwright::st_test {

// Throws std::runtime_error with the diagnostics if it does not compile.
reader::LoadedProgram compiled(const std::string& text,
                               const source::Dialect& dialect = source::standard_dialect());

}  // namespace stepwright::st_test
