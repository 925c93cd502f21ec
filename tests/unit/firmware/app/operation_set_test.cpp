#include "firmware/app/operation_set.h"

#include <gtest/gtest.h>

#include "runtime/bytecode/reader/loaded_program.h"
#include "tests/unit/firmware/app/programs.h"

namespace stepwright::test {
namespace {

bool is_basic(const std::string& body) {
  const auto loaded = reader::LoadedProgram::load(
      compiled("PROGRAM main VAR x : REAL; y : LREAL; n : DINT; s : STRING[9]; t : TON; END_VAR " + body +
               " END_PROGRAM"),
      "test");
  return loaded && app::is_basic(loaded->program());
}

TEST(OperationSet, Program_WhenItComputesAndCounts_ThenIsBasic) {
  const auto loaded = reader::LoadedProgram::load(
      compiled("PROGRAM main VAR x : REAL; n : DINT; t : TON; c : CTU; END_VAR "
               "x := SQRT(ABS(x * 0.5 + MIN(x, 3.0))); n := REAL_TO_DINT(x); t(IN := n > 3, PT := T#1s); "
               "c(CU := t.Q, PV := 5); END_PROGRAM"),
      "test");
  ASSERT_TRUE(loaded);
  EXPECT_TRUE(app::is_basic(loaded->program()));
}

TEST(OperationSet, Program_WhenItUsesStringsOrElementaryFunctions_ThenIsNotBasic) {
  EXPECT_FALSE(is_basic("x := SIN(x);"));
  EXPECT_FALSE(is_basic("y := LN(y + 1.0);"));
  EXPECT_FALSE(is_basic("y := EXPT(y, 2.0);"));
  EXPECT_FALSE(is_basic("s := CONCAT(s, 'a');"));
  EXPECT_FALSE(is_basic("n := STRING_TO_DINT(s);"));
}

}  // namespace
}  // namespace stepwright::test
