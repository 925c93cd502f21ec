// Libraries in the size of OSCAT.

#include <gtest/gtest.h>

#include "tests/support/compiled_program.h"
#include "tests/support/pou_library.h"

namespace {

using namespace stepwright;

driver::CompileInput input_of(const support::PouLibrary& library) {
  driver::CompileInput input;
  input.texts.push_back({"library.st", library.text});
  return input;
}

TEST(LibrarySize, Compile_WhenTheLibraryHas500Pous_ThenAllOfThemRun) {
  const support::PouLibrary library = support::pou_library(500);
  support::CompiledProgram program(input_of(library));
  ASSERT_FALSE(program.scan().trap);
  EXPECT_EQ(program.get("main.sum"), library.sum);
  EXPECT_EQ(program.get("main.ticks"), library.ticks);
}

// What each POU adds to the container does not grow with the library.
TEST(LibrarySize, Container_WhenTheLibraryDoubles_ThenItDoublesToo) {
  const auto size = [](int count) {
    const auto output = driver::compile(input_of(support::pou_library(count)));
    return output ? static_cast<double>(output->container.size()) : 0.0;
  };
  const double small = size(100);
  ASSERT_GT(small, 0);
  EXPECT_NEAR(size(200) / small, 2, 0.3);
}

}  // namespace
