#include "cell/config/tag_config.h"

#include <gtest/gtest.h>

namespace stepwright::config {
namespace {

struct Read {
  std::vector<TagConfig> tags;
  result::Diagnostics problems;
};

Read read(const std::string& text) {
  auto document = settings::TomlDocument::parse(text, "cell.toml");
  EXPECT_TRUE(document) << text;
  Read read;
  read.tags = read_tags((*document)->root().table("tags"));
  read.problems = (*document)->finish();
  return read;
}

TEST(TagConfig, WhenACellSaysNothing_ThenThereAreNone) {
  const Read nothing = read("");
  EXPECT_TRUE(nothing.tags.empty());
  EXPECT_TRUE(nothing.problems.empty());
}

TEST(TagConfig, WhenATagIsDescribed_ThenAllOfItIsRead) {
  const Read whole = read(
      "[tags.\"Main.level\"]\nunit = \"l\"\ndescription = \"level of the buffer\"\ngroup = \"buffer\"\n"
      "decimals = 1\nrange = [0, 200.5]\n[tags.mode]\nvalues = [\"off\", \"by hand\"]\n");
  EXPECT_TRUE(whole.problems.empty());
  ASSERT_EQ(whole.tags.size(), 2u);
  const TagConfig& level = whole.tags[0];
  EXPECT_EQ(level.name, "Main.level");
  EXPECT_EQ(level.unit, "l");
  EXPECT_EQ(level.description, "level of the buffer");
  EXPECT_EQ(level.group, "buffer");
  EXPECT_EQ(level.decimals, 1);
  ASSERT_TRUE(level.range);
  EXPECT_EQ(level.range->low, 0.0);
  EXPECT_EQ(level.range->high, 200.5);
  EXPECT_EQ(level.where.line, 1u);
  EXPECT_EQ(whole.tags[1].values, (std::vector<std::string>{"off", "by hand"}));
  EXPECT_FALSE(whole.tags[1].decimals);
  EXPECT_FALSE(whole.tags[1].range);
}

TEST(TagConfig, WhenItIsWrong_ThenTheKeyIsNamed) {
  const auto problem = [](const std::string& text) {
    const Read wrong = read(text);
    EXPECT_EQ(wrong.problems.size(), 1u) << text;
    return wrong.problems.empty()
               ? ""
               : wrong.problems.front().code + " " + std::to_string(wrong.problems.front().where.line);
  };
  EXPECT_EQ(problem("[tags.x]\nunits = \"l\"\n"), "C0002 2");
  EXPECT_EQ(problem("[tags.x]\nunit = 3\n"), "C0003 2");
  EXPECT_EQ(problem("[tags.x]\ndecimals = 10\n"), "C0004 2");
  EXPECT_EQ(problem("[tags.x]\nrange = [5, 5]\n"), "C0631 2");
  EXPECT_EQ(problem("[tags.x]\nrange = [5]\n"), "C0631 2");
  EXPECT_EQ(problem("[tags.x]\nvalues = [1, 2]\n"), "C0003 2");
  EXPECT_EQ(problem("[tags.\"\"]\nunit = \"l\"\n"), "C0630 1");
  EXPECT_EQ(problem("[tags.\"Main.x\"]\nunit = \"l\"\n[tags.\"MAIN.X\"]\nunit = \"m\"\n"), "C0630 3");
  EXPECT_EQ(problem("[tags]\nx = 3\n"), "C0003 2");
}

}  // namespace
}  // namespace stepwright::config
