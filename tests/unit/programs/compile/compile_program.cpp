#include "tests/unit/programs/compile/compile_program.h"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace stepwright::compile_test {

void CompileProgram::SetUp() {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  folder_ = std::filesystem::path(testing::TempDir()) / (std::string("compile_") + test->name());
  std::filesystem::remove_all(folder_);
  std::filesystem::create_directories(folder_);
}

std::string CompileProgram::write(const std::string& name, const std::string& text) const {
  std::ofstream(folder_ / name, std::ios::binary) << text;
  return path(name);
}

std::string CompileProgram::text(const std::string& name) const {
  std::ostringstream out;
  out << std::ifstream(folder_ / name, std::ios::binary).rdbuf();
  return out.str();
}

int CompileProgram::run_program(const std::string& program, const std::string& arguments) {
  const std::string command =
      STEPWRIGHT_BIN_DIR "/" + program + " " + arguments + " >" + path("out") + " 2>" + path("err");
  const int status = std::system(command.c_str());
  output = text("out");
  errors = text("err");
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace stepwright::compile_test
