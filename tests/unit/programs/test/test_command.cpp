#include "tests/unit/programs/test/test_command.h"

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace stepwright::test_program {

void TestCommand::SetUp() {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string("test_") + test->test_suite_name() + "_" + test->name();
  std::replace(name.begin(), name.end(), '/', '_');
  folder_ = std::filesystem::path(testing::TempDir()) / name;
  std::filesystem::remove_all(folder_);
  std::filesystem::create_directories(folder_);
}

std::string TestCommand::write(const std::string& name, const std::string& text) const {
  std::ofstream(folder_ / name, std::ios::binary) << text;
  return path(name);
}

std::string TestCommand::text(const std::string& name) const {
  std::ostringstream out;
  out << std::ifstream(folder_ / name, std::ios::binary).rdbuf();
  return out.str();
}

int TestCommand::run_program(const std::string& program, const std::string& arguments) {
  const std::string command =
      STEPWRIGHT_BIN_DIR "/" + program + " " + arguments + " >" + path("out") + " 2>" + path("err");
  const int status = std::system(command.c_str());
  output = text("out");
  errors = text("err");
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

int TestCommand::run(const std::string& arguments) {
  return run_program("stepwright-test", "test " + arguments + " --json " + path("report.json"));
}

}  // namespace stepwright::test_program
