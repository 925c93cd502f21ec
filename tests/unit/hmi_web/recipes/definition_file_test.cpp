#include "hmi_web/recipes/definition_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace stepwright::recipes {
namespace {

result::Result<std::vector<RecipeTag>> load(const std::string& text) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "recipes.toml") << text;
  return load_definitions(folder / "recipes.toml");
}

// "C0620 3:8 C0005 1:1"
std::string problems(const std::string& text) {
  const auto loaded = load(text);
  std::string all;
  if (loaded) return all;
  for (const auto& problem : loaded.error()) {
    EXPECT_TRUE(problem.where.file.ends_with("recipes.toml"));
    if (problem.code.starts_with("C062")) {
      EXPECT_FALSE(problem.hint.empty()) << problem.message;
    }
    all += (all.empty() ? "" : " ") + problem.code + " " + std::to_string(problem.where.line) + ":" +
           std::to_string(problem.where.column);
  }
  return all;
}

TEST(RecipeDefinitions, WhenTheFileIsRight_ThenEveryKeyIsTaken) {
  const auto tags = load(R"(
[[tag]]
name = "mixer.level"
type = "REAL"
min = 0.5
max = 99
unit = "%"
comment = "how full"

[[tag]]
name = "mixer.stir"
type = "TIME"
min = 0
max = 3600

[[tag]]
name = "%QX0.3"
type = "BOOL"
)");
  ASSERT_TRUE(tags) << result::to_string(tags.error());
  ASSERT_EQ(tags->size(), 3u);
  const RecipeTag& level = tags->at(0);
  EXPECT_EQ(level.name, "mixer.level");
  EXPECT_EQ(level.type, bytecode::ElementaryType::Real);
  EXPECT_EQ(level.least, 0.5);
  EXPECT_EQ(level.most, 99);
  EXPECT_EQ(level.unit, "%");
  EXPECT_EQ(level.comment, "how full");
  EXPECT_EQ(tags->at(1).unit, "s") << "the range of a TIME is in seconds";
  EXPECT_EQ(tags->at(2).type, bytecode::ElementaryType::Bool);
}

TEST(RecipeDefinitions, WhenSomethingIsWrong_ThenItIsToldWithItsPlace) {
  const std::string tag = "[[tag]]\nname = \"a\"\ntype = \"INT\"\n";
  EXPECT_EQ(problems(tag + "min = 1\nmax = 5\n"), "");
  EXPECT_EQ(problems(tag + "min = 6\nmax = 5\n"), "C0621 5:7");
  EXPECT_EQ(problems(tag + "min = -32769\nmax = 5\n"), "C0621 4:7") << "beyond the type";
  EXPECT_EQ(problems(tag + "min = 1\nmax = nan\n").substr(0, 5), "C0004") << "no range";
  EXPECT_EQ(problems(tag + "min = 1\n").substr(0, 5), "C0005");
  EXPECT_EQ(problems(tag + "min = 1\nmax = 5\nmaks = 6\n"), "C0002 6:1");
  EXPECT_EQ(problems("[[tag]]\nname = \"a\"\nmin = 1\nmax = 5\n").substr(0, 5), "C0005") << "no type";
  EXPECT_EQ(problems("[[tag]]\nname = \"a\"\ntype = \"STRING\"\nmin = 1\nunit = \"l\"\n"),
            "C0622 4:7 C0622 5:8");
  EXPECT_EQ(problems("[[tag]]\nname = \"a\"\ntype = \"WSTRING\"\n"), "");
  EXPECT_NE(problems("[[tag]]\nname = \"a\"\ntype = \"DATE\"\nmin = 1\nmax = 5\n"), "");
  EXPECT_EQ(problems("[[tag]]\nname = \"a\"\ntype = \"BOOL\"\nmin = 0\n"), "C0622 4:7");
  EXPECT_EQ(problems("[[tag]]\nname = \"\"\ntype = \"BOOL\"\n"), "C0620 2:8");
  EXPECT_EQ(problems("").substr(0, 5), "C0620") << "nothing to set";
  EXPECT_EQ(problems(tag + "min = 1\nmax = 5\n" + tag + "min = 1\nmax = 5\n"), "C0620 7:8");
}

TEST(RecipeDefinitions, WhenThereAreTooMany_ThenTheyAreRefused) {
  std::string text;
  for (std::size_t i = 0; i < kMostTags; ++i)
    text += "[[tag]]\nname = \"a" + std::to_string(i) + "\"\ntype = \"BOOL\"\n";
  EXPECT_EQ(problems(text), "");
  EXPECT_NE(problems(text + "[[tag]]\nname = \"one\"\ntype = \"BOOL\"\n").find("C0620"), std::string::npos);
}

TEST(RecipeDefinitions, WhenThereIsNoFile_ThenItsNameIsTold) {
  const auto loaded = load_definitions("/none/recipes.toml");
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error()[0].where.file, "/none/recipes.toml");
}

}  // namespace
}  // namespace stepwright::recipes
