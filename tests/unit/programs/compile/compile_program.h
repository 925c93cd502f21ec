#pragma once

// Runs stepwright-compile as a user would, in a folder of the test.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace stepwright::compile_test {

class CompileProgram : public testing::Test {
 protected:
  void SetUp() override;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  // The path of a new file.
  std::string write(const std::string& name, const std::string& text) const;
  std::string text(const std::string& name) const;
  // The exit code; `output` and `errors` are what the program said.
  int run(const std::string& arguments) { return run_program("stepwright-compile", arguments); }
  int run_program(const std::string& program, const std::string& arguments);

  std::string output;
  std::string errors;

 private:
  std::filesystem::path folder_;
};

}  // namespace stepwright::compile_test
