#pragma once

// The command `stepwright test` as a user runs it, in a folder of its own.

#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/command_run.h"

namespace stepwright::test_program {

class TestCommand : public support::CommandRun {
 protected:
  // `stepwright-test test ARGUMENTS --json report.json`
  int run(const std::string& arguments) {
    return run_program("stepwright-test", "test " + arguments + " --json " + path("report.json"));
  }
  nlohmann::json report() const { return nlohmann::json::parse(text("report.json")); }
};

}  // namespace stepwright::test_program
