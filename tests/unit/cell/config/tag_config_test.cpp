#include "cell/config/tag_config.h"

#include <gtest/gtest.h>

#include <fstream>

#include "cell/config/tag_table.h"

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
  EXPECT_EQ(problem("[tags.x]\nrange = [0, inf]\n"), "C0631 2");
  EXPECT_EQ(problem("[tags.x]\nvalues = [1, 2]\n"), "C0003 2");
  EXPECT_EQ(problem("[tags.\"\"]\nunit = \"l\"\n"), "C0630 1");
  EXPECT_EQ(problem("[tags.\"Main.x\"]\nunit = \"l\"\n[tags.\"MAIN.X\"]\nunit = \"m\"\n"), "C0630 3");
  EXPECT_EQ(problem("[tags]\nx = 3\n"), "C0003 2");
}

// As a spreadsheet saves it; `before`: what [tags] says.
Read read_table(const std::string& text, std::vector<TagConfig> before = {}) {
  const auto file = std::filesystem::path(testing::TempDir()) / "tags.csv";
  std::ofstream(file) << text;
  Read read{std::move(before), {}};
  read.problems = read_tag_table(file, read.tags);
  return read;
}

TEST(TagTable, WhenASpreadsheetSavesIt_ThenAllOfItIsRead) {
  const Read whole = read_table(
      "\xEF\xBB\xBFname,type,unit,description,group,decimals,least,greatest,values\r\n"
      "Main.level,REAL,l,\"level, \"\"net\"\"\",buffer,1,0,200.5,\r\nMain.other,REAL,,,,,,,\r\n"
      "Main.mode,INT,,,,,,,off|by hand\r\nMain.way,INT,,,,,,,a\\|b|c\\\\||\\d\r\n");
  EXPECT_TRUE(whole.problems.empty());
  ASSERT_EQ(whole.tags.size(), 3u) << "a row that says nothing is none";
  EXPECT_EQ(whole.tags[0].description, "level, \"net\"");
  EXPECT_EQ(whole.tags[0].decimals, 1);
  ASSERT_TRUE(whole.tags[0].range);
  EXPECT_EQ(whole.tags[0].range->high, 200.5);
  EXPECT_EQ(whole.tags[0].where.line, 2u);
  EXPECT_EQ(whole.tags[1].values, (std::vector<std::string>{"off", "by hand"}));
  EXPECT_EQ(whole.tags[2].values, (std::vector<std::string>{"a|b", "c\\", "", "\\d"}));
}

TEST(TagTable, WhenThereIsNone_ThenNothingIsSaid) {
  std::vector<TagConfig> tags;
  EXPECT_TRUE(read_tag_table({}, tags).empty());
}

TEST(TagTable, WhenItIsWrong_ThenTheLineIsNamedAndTheNextOnesAreReadAllTheSame) {
  const auto problem = [](const std::string& text, std::vector<TagConfig> before = {}) {
    const Read wrong = read_table(text, std::move(before));
    EXPECT_EQ(wrong.problems.size(), 1u) << text;
    return wrong.problems.empty()
               ? ""
               : wrong.problems.front().code + " " + std::to_string(wrong.problems.front().where.line);
  };
  const std::string head = "name,unit,decimals,least,greatest\n";
  EXPECT_EQ(problem(""), "C0633 1");
  EXPECT_EQ(problem("tag,unit\nx,l\n"), "C0633 1");
  EXPECT_EQ(problem(head + "x,l,1,,\ny,l,10,,\n"), "C0633 3");
  EXPECT_EQ(problem(head + "x,l,1.5,,\n"), "C0633 2");
  EXPECT_EQ(problem(head + "x,l,one,,\n"), "C0633 2");
  EXPECT_EQ(problem(head + "x,l,nan,,\n"), "C0633 2");
  EXPECT_EQ(problem(head + "x,l,,nan,5\n"), "C0633 2");
  EXPECT_EQ(problem(head + "x,l,,0,inf\n"), "C0633 2");
  EXPECT_EQ(problem(head + "x,l,,5,5\n"), "C0631 2");
  EXPECT_EQ(problem(head + "x,l,,5,\n"), "C0631 2");
  EXPECT_EQ(problem(head + ",l,,,\n"), "C0630 2");
  EXPECT_EQ(problem(head + "x,l,,,\nX,m,,,\n"), "C0630 3");
  EXPECT_EQ(problem(head + "x,\"l\n"), "C0633 2");
  EXPECT_EQ(problem(head + "x,l,,,\ny,\xB0"
                           "C,,,\n"),
            "C0633 3")
      << "Latin-1";
  EXPECT_EQ(problem(head + "x,l,,,,more\n"), "C0633 2") << "more fields than columns";
  EXPECT_EQ(problem("name,unit,unit\nx,l,m\n"), "C0633 1");
  TagConfig described;
  described.name = "Main.X";
  EXPECT_EQ(problem(head + "main.x,l,,,\n", {described}), "C0630 2");
  std::vector<TagConfig> tags;
  EXPECT_EQ(read_tag_table("/nowhere/tags.csv", tags).front().code, "E0001");
  EXPECT_EQ(read_table(head + "x,l,one,,\ny,m,,5,5\nz,s,,,\n").problems.size(), 2u);
}

TEST(TagTable, WhenItIsSeparatedBySomethingElse_ThenThatIsSaid) {
  for (const auto& [text, separator] :
       {std::pair{"name;unit\nx;l\n", "';'"}, {"name\tunit\nx\tl\n", "tabs"}}) {
    const Read wrong = read_table(text);
    ASSERT_EQ(wrong.problems.size(), 1u);
    EXPECT_EQ(wrong.problems[0].message,
              "this table is separated by " + std::string(separator) + " and not by commas");
  }
}

TEST(TagTable, WhenTheColumnOfNamesIsMisspelt_ThenNameIsMeant) {
  for (const char* column : {"Name", "nmae", "NAMES"}) {
    const Read wrong = read_table("Unit," + std::string(column) + "\nl,x\n");
    ASSERT_EQ(wrong.problems.size(), 1u) << column;
    EXPECT_EQ(wrong.problems[0].where.column, 6u);
    EXPECT_EQ(wrong.problems[0].message, "the column '" + std::string(column) + "' is not read");
    EXPECT_TRUE(wrong.problems[0].hint.starts_with("did you mean 'name'?")) << wrong.problems[0].hint;
  }
}

TEST(TagTable, WhenRowsHaveNothingInThem_ThenTheyAreNone) {
  const Read read = read_table("name,unit\n,\nx,l\n,,\n\n\"\",\n");
  EXPECT_TRUE(read.problems.empty()) << result::to_string(read.problems);
  EXPECT_EQ(read.tags.size(), 1u);
}

TEST(TagTable, WhenAColumnIsNearlyOneThatIsRead_ThenThatIsAWarning) {
  for (const char* column : {"Unit", "units"}) {
    const Read near = read_table("name," + std::string(column) + "\nx,l\n");
    ASSERT_EQ(near.problems.size(), 1u) << column;
    EXPECT_EQ(near.problems[0].severity, result::Severity::Warning);
    EXPECT_EQ(near.problems[0].where.column, 6u);
    EXPECT_EQ(near.problems[0].hint, "did you mean 'unit'?");
  }
  EXPECT_TRUE(read_table("name,type,address,unit,note\nx,REAL,%MD0,l,,\n").problems.empty()) << "for people";
}

}  // namespace
}  // namespace stepwright::config
