#pragma once

// Runs stepwright-compile as a user would, in a folder of the test.

#include <string>

#include "tests/support/command_run.h"

namespace stepwright::compile_test {

class CompileProgram : public support::CommandRun {
 protected:
  int run(const std::string& arguments) { return run_program("stepwright-compile", arguments); }
};

}  // namespace stepwright::compile_test
