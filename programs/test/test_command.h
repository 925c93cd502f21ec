#pragma once

// The command `test`: compiles sources, runs their tests, reports.

#include <string>
#include <vector>

#include "cell/testing/suite_runner.h"
#include "ladder/source_files/source_options.h"
#include "runtime/ground/result/exit_code.h"

namespace stepwright::test_program {

struct TestArguments {
  std::vector<std::string> sources;
  sources::SourceOptions source_options;
  std::string filter;  // glob over the names of tests; empty: all
  std::string json_file;
  std::string junit_file;
  std::string engine = "auto";
  cell_testing::RunOptions options;
};

// One line for each test on stdout, failures with their source line; diagnostics of the sources on stderr.
// BadInput if a test failed, a source is wrong or there is nothing to run.
result::ExitCode run_tests(const TestArguments& arguments);

}  // namespace stepwright::test_program
