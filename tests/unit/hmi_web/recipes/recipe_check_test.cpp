#include "hmi_web/recipes/recipe_check.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace stepwright::recipes {
namespace {

using bytecode::ElementaryType;

RecipeTag tag(ElementaryType type, double least, double most, const std::string& name = "t") {
  return {name, type, least, most, "", "", {}};
}

std::string outcome(const RecipeTag& of, const std::string& literal) {
  const auto checked = check_value(of, literal);
  return checked ? *checked : checked.error().front().code;
}

TEST(RecipeCheck, WhenAValueIsInItsRange_ThenItIsSpeltAsTheProgramDoes) {
  EXPECT_EQ(outcome(tag(ElementaryType::Real, 0, 1), "0.1"), "0.1") << "no double between 0.1 and its REAL";
  EXPECT_EQ(outcome(tag(ElementaryType::Int, -5, 300), "16#FF"), "255");
  EXPECT_EQ(outcome(tag(ElementaryType::Int, -5, 300), "-5"), "-5");
  EXPECT_EQ(outcome(tag(ElementaryType::Bool, 0, 0), "true"), "TRUE") << "a BOOL has no range";
  EXPECT_EQ(outcome(tag(ElementaryType::Time, 0, 90), "T#1m30s"),
            outcome(tag(ElementaryType::Time, 0, 90), "T#90s"));
  EXPECT_EQ(outcome(tag(ElementaryType::Lword, 0, 1e19), "16#8000000000000000"), "9223372036854775808");
}

TEST(RecipeCheck, WhenAValueIsBeyondItsRange_ThenItIsRefused) {
  EXPECT_EQ(outcome(tag(ElementaryType::Real, 0, 1), "1.0001"), "H0077");
  EXPECT_EQ(outcome(tag(ElementaryType::Real, 0, 1), "-0.0001"), "H0077");
  EXPECT_EQ(outcome(tag(ElementaryType::Int, -5, 300), "-6"), "H0077");
  EXPECT_EQ(outcome(tag(ElementaryType::Time, 0, 90), "T#90s1ms"), "H0077");
  const double infinite = std::numeric_limits<double>::infinity();
  for (const char* text : {"nan", "NaN", "inf", "1e999"})
    EXPECT_TRUE(outcome(tag(ElementaryType::Lreal, -infinite, 1e300), text).starts_with("H00")) << text;
}

TEST(RecipeCheck, WhenAValueIsNoLiteralOfItsType_ThenItIsRefused) {
  for (const char* text : {"", "many", "1.5", "40000", "T#1s", "1;2", "1 2"})
    EXPECT_EQ(outcome(tag(ElementaryType::Int, -5, 300), text), "H0076") << text;
  EXPECT_EQ(outcome(tag(ElementaryType::Time, 0, 90), "90"), "H0076");
  EXPECT_EQ(outcome(tag(ElementaryType::Int, -5, 300), std::string(65, '1')), "H0076");
}

TEST(RecipeCheck, WhenTheVariableIsAnEnumeration_ThenItsNamesAreValues) {
  RecipeTag mode = tag(ElementaryType::Int, 0, 4);
  EXPECT_EQ(outcome(mode, "Auto"), "H0076") << "it is none";
  mode.program_unknown = true;
  EXPECT_EQ(outcome(mode, "Mode#Auto"), "Mode#Auto") << "it may be one";
  EXPECT_EQ(outcome(mode, "1.5"), "H0076");
  mode.program_unknown = false;
  mode.names =
      std::make_shared<const reader::Enumerators>(reader::Enumerators{{0, "Off"}, {4, "Auto"}, {7, "Test"}});
  EXPECT_EQ(outcome(mode, "auto"), "Auto");
  EXPECT_EQ(outcome(mode, "Mode#Auto"), "Auto");
  EXPECT_EQ(outcome(mode, "4"), "Auto");
  EXPECT_EQ(outcome(mode, "Other"), "H0076");
  EXPECT_EQ(outcome(mode, "Test"), "H0077");
}

TEST(RecipeCheck, WhenATagIsAText_ThenItIsKeptAsItIsWritten) {
  EXPECT_EQ(outcome(tag(ElementaryType::String, 0, 0), "batch 7"), "batch 7");
  EXPECT_EQ(outcome(tag(ElementaryType::String, 0, 0), "''"), "''");
  EXPECT_EQ(outcome(tag(ElementaryType::String, 0, 0), "'$4'"), "H0076") << "no escape";
  EXPECT_EQ(outcome(tag(ElementaryType::String, 0, 0), "\u20AC"), "H0076");
  EXPECT_EQ(outcome(tag(ElementaryType::Wstring, 0, 0), "\u20AC"), "\u20AC");
}

TEST(RecipeCheck, WhenSeveralThingsAreWrong_ThenAllAreTold) {
  const std::vector<RecipeTag> tags = {tag(ElementaryType::Int, 0, 9, "a"),
                                       tag(ElementaryType::Int, 0, 9, "b"),
                                       tag(ElementaryType::Int, 0, 9, "speed")};
  const auto checked = check(tags, {{"a", "10"}, {"spede", "1"}});
  ASSERT_FALSE(checked);
  std::string codes;
  for (const auto& problem : checked.error()) codes += problem.code + " ";
  EXPECT_EQ(codes, "H0077 H0074 H0074 H0075 ");
  EXPECT_EQ(checked.error()[0].message, "a: 10 is out of range");
  EXPECT_EQ(checked.error()[0].hint, "0 to 9");
  EXPECT_EQ(checked.error()[3].hint, "did you mean 'speed'?");
  const auto right = check(tags, {{"a", "1"}, {"b", "2"}, {"speed", "3"}});
  ASSERT_TRUE(right);
  EXPECT_EQ(text_of(*right), "a = 1, b = 2, speed = 3");
}

TEST(RecipeCheck, WhenANameCouldLeaveTheFolderOrHide_ThenItIsRefused) {
  for (const char* name :
       {"", ".", "..", "../x", "a/b", "a\\b", ".hidden", " a", "a ", "a.", "-a", "a\n", "é"})
    EXPECT_FALSE(check_name(name)) << name;
  EXPECT_FALSE(check_name(std::string("a\0b", 3)));
  EXPECT_FALSE(check_name(std::string(kLongestName + 1, 'a')));
  for (const char* name : {"a", "Blue 20 l", "v1.2_b-3"}) EXPECT_TRUE(check_name(name)) << name;
  EXPECT_TRUE(check_name(std::string(kLongestName, 'a')));
}

}  // namespace
}  // namespace stepwright::recipes
