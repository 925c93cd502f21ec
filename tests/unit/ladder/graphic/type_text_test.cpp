#include "ladder/graphic/type_text.h"

#include <gtest/gtest.h>

#include "ladder/graphic/identifier.h"

namespace stepwright::graphic {
namespace {

using Strings = std::vector<std::string>;

TEST(TypeText, WhenSplit_ThenBracketsStringsAndStructuresHoldTogether) {
  EXPECT_EQ(split_outside("a, b(c, d) , 'e, f', \"g,$\",\"", ','),
            (Strings{"a", "b(c, d)", "'e, f'", "\"g,$\",\""}));
  EXPECT_EQ(split_outside("a : INT; s : STRUCT b : INT; c : INT; END_STRUCT; ", ';'),
            (Strings{"a : INT", "s : STRUCT b : INT; c : INT; END_STRUCT"}));
  EXPECT_EQ(find_outside("'a:=b' := 3", ":="), 7U);
  EXPECT_EQ(find_outside("f(a := 1)", ":="), std::string::npos);
  EXPECT_EQ(split_outside("'open", ','), Strings{"'open"});
}

TEST(TypeText, WhenATypeOnlyBeginsLikeAString_ThenItIsNone) {
  EXPECT_TRUE(is_string_type("string[20]"));
  EXPECT_TRUE(is_string_type("WSTRING"));
  EXPECT_TRUE(is_string_type("STRING (5)"));
  EXPECT_FALSE(is_string_type("StringList"));
  EXPECT_FALSE(is_string_type("STRING_ID"));
}

TEST(TypeText, WhenArraysAreNested_ThenTheElementIsTheInnerArray) {
  EXPECT_EQ(element_type("ARRAY[0..3] OF ARRAY [1..2, 0..OF_MAX] OF STRING[5]"),
            "ARRAY [1..2, 0..OF_MAX] OF STRING[5]");
  EXPECT_EQ(element_type("ARRAY [1..2, 0..OF_MAX] OF STRING[5]"), "STRING[5]");
  EXPECT_EQ(element_type("ArrayOfThings"), "");
  EXPECT_EQ(element_type("ARRAY"), "");
}

TEST(TypeText, WhenAStructureIsTakenApart_ThenItIsPutTogetherAgain) {
  const std::string text =
      "STRUCT a : INT := 1; b AT %QW1 : STRUCT c : STRING := ';:='; END_STRUCT; d : ARRAY[1..2] OF INT := "
      "[1, "
      "2]; END_STRUCT";
  const std::vector<StructureMember> members = members_of(text);
  ASSERT_EQ(members.size(), 3U);
  EXPECT_EQ(members[1].address, "%QW1");
  EXPECT_EQ(members[1].type, "STRUCT c : STRING := ';:='; END_STRUCT");
  EXPECT_EQ(members[2].initial, "[1, 2]");
  EXPECT_EQ(structure_text(members), text);
}

std::string behind(const std::string& name) {
  if (same_name(name, "Caption")) return "STRING[20]";
  if (same_name(name, "Wide")) return "WSTRING";
  if (same_name(name, "Line")) return "STRUCT text : Caption; size : INT; END_STRUCT";
  return name;
}

TEST(TypeText, WhenStringsHaveNoQuotes_ThenTheyGetThem) {
  EXPECT_EQ(with_quotes("blup", "Caption", behind), "'blup'");
  EXPECT_EQ(with_quotes("blup", "WIDE", behind), "\"blup\"");
  EXPECT_EQ(with_quotes("#ff0000", "STRING", behind), "'#ff0000'");
  EXPECT_EQ(with_quotes("it's 5$", "STRING", behind), "'it$'s 5$$'");
  EXPECT_EQ(with_quotes("a$Nb$0D$'", "STRING", behind), "'a$Nb$0D$''");
  EXPECT_EQ(with_quotes("3(blup), 'x'", "ARRAY[1..4] OF Caption", behind), "3(blup), 'x'");
  EXPECT_EQ(with_quotes("[3(blup), 'x']", "ARRAY[1..4] OF Caption", behind), "[3('blup'), 'x']");
  EXPECT_EQ(with_quotes("[(text := a, size := b), (size := 2)]", "ARRAY[1..2] OF Line", behind),
            "[(text := 'a', size := b), (size := 2)]");
  EXPECT_EQ(with_quotes_inside("STRUCT a : Caption := x; b : Color := red; END_STRUCT", behind),
            "STRUCT a : Caption := 'x'; b : Color := red; END_STRUCT");
}

TEST(TypeText, WhenItIsALiteralOrNoString_ThenItStays) {
  EXPECT_EQ(with_quotes("'blup'", "Caption", behind), "'blup'");
  EXPECT_EQ(with_quotes("STRING#'a'", "Caption", behind), "STRING#'a'");
  EXPECT_EQ(with_quotes("blup", "Color", behind), "blup");
  EXPECT_EQ(with_quotes("", "Caption", behind), "");
}

}  // namespace
}  // namespace stepwright::graphic
