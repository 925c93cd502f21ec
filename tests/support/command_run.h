#pragma once

// Commands of the binaries' folder, run as a user would in a folder of the test's own.
//
// For tests whose target defines STEPWRIGHT_BIN_DIR.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace stepwright::support {

class CommandRun : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  // The path of a new file.
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return path(name);
  }
  std::string text(const std::string& name) const {
    std::ostringstream out;
    out << std::ifstream(folder_ / name, std::ios::binary).rdbuf();
    return out.str();
  }

  // The exit code; `output` and `errors` are what the program said.
  int run_program(const std::string& program, const std::string& arguments) {
    const std::string command =
        STEPWRIGHT_BIN_DIR "/" + program + " " + arguments + " >" + path("out") + " 2>" + path("err");
    const int status = std::system(command.c_str());
    output = text("out");
    errors = text("err");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string output;
  std::string errors;

 private:
  TemporaryFolder folder_;
};

}  // namespace stepwright::support
