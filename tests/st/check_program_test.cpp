// The driver itself can fail: a wrong expectation is reported with its line.

#include "tests/st/check_program.h"

#include <gtest/gtest.h>

namespace {

using stepwright::st_test::run_checks;

std::string main_with(const std::string& body) {
  return "PROGRAM main\nVAR x : INT; zero : INT; END_VAR\n" + body + "\nEND_PROGRAM\n";
}

TEST(CheckProgram, Checks_WhenAValueIsWrong_ThenTheLineIsReported) {
  const auto failures = run_checks("wrong.st", main_with("x := 4; (* CHECK x = 5 *)"));
  ASSERT_EQ(failures.size(), 1u);
  EXPECT_EQ(failures[0], "wrong.st:3: x is 4, not 5");
}

TEST(CheckProgram, Checks_WhenATrapComesUnexpectedly_ThenItIsReported) {
  const auto failures = run_checks("trap.st", main_with("x := 1 / zero; (* CHECK x = 0 *)"));
  ASSERT_EQ(failures.size(), 1u);
  EXPECT_EQ(failures[0].rfind("unexpected trap: trap.st:3", 0), 0u) << failures[0];
}

TEST(CheckProgram, Checks_WhenATrapIsElsewhere_ThenItIsReported) {
  EXPECT_TRUE(
      run_checks("trap.st", main_with("x := 1 / zero; (* CHECK trap scan 1: division by zero *)")).empty());
  EXPECT_EQ(run_checks("trap.st", main_with("x := 1 / zero; (* CHECK trap scan 1: division by zero at 4 *)"))
                .size(),
            1u);
  EXPECT_EQ(run_checks("trap.st", main_with("x := 1; (* CHECK trap scan 1: division by zero *)")).size(), 1u);
}

TEST(CheckProgram, Errors_WhenTheyDiffer_ThenBothAreReported) {
  EXPECT_TRUE(run_checks("error.st", main_with("y := 1; (* ERROR E0201 at 3:1 *)")).empty());
  EXPECT_EQ(run_checks("error.st", main_with("y := 1; (* ERROR E0301 *)")).size(), 2u);
  EXPECT_EQ(run_checks("error.st", main_with("x := 1; (* ERROR E0301 *)")).size(), 1u);
}

TEST(CheckProgram, Directives_WhenOneIsMalformed_ThenItIsRefused) {
  EXPECT_EQ(run_checks("bad.st", main_with("x := 1; (* CHECK scan 1 x *)")).size(), 1u);
}

}  // namespace
