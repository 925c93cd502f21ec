#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "ladder/semantics/standard_functions/standard_analyzer.h"

namespace {

TEST(StandardFunctions, Document_WhenComparedWithTheCompiler_ThenEachFunctionIsInIt) {
  std::ifstream file(STEPWRIGHT_SOURCE_DIR "/ladder/doc/standard_functions.md");
  const std::string document{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  std::vector<std::string_view> names;
  stepwright::semantics::internal::StandardAnalyzer::add_names(names);
  EXPECT_GT(names.size(), 70u);
  for (const std::string_view name : names) {
    // ADD_LTIME is in the row of ADD_TIME: the long types are the same.
    const bool is_long =
        name.find("_L") != std::string_view::npos && name.find("_LITTLE") == std::string_view::npos;
    const bool found = document.find("`" + std::string(name) + "`") != std::string::npos;
    EXPECT_TRUE(found || is_long) << name;
  }
}

}  // namespace
