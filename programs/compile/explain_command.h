#pragma once

// The command `explain`: the page of a code, or the rows of the documents that speak of it.

#include <string>

#include "runtime/ground/result/exit_code.h"

namespace stepwright::compile_program {

// Prints the page or the rows to stdout; without a code the list of all codes. An unknown code is BadInput,
// with a suggestion on stderr.
result::ExitCode run_explain(const std::string& code);

}  // namespace stepwright::compile_program
