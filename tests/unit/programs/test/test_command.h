#pragma once

// The command `stepwright test` as a user runs it, in a folder of its own.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace stepwright::test_program {

class TestCommand : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const;
  std::string text(const std::string& name) const;

  // Runs a command of the binaries' folder and gives its exit code; `output` and `errors` are what it said.
  int run_program(const std::string& program, const std::string& arguments);
  // `stepwright-test test ARGUMENTS --json report.json`
  int run(const std::string& arguments);
  nlohmann::json report() const { return nlohmann::json::parse(text("report.json")); }

  std::string output;
  std::string errors;

 private:
  std::filesystem::path folder_;
};

}  // namespace stepwright::test_program
