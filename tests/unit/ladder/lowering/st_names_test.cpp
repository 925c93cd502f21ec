#include "ladder/lowering/st_names.h"

#include <gtest/gtest.h>

#include <vector>

namespace stepwright::lowering {
namespace {

std::string mark(std::string_view name, char flag) {
  return name.front() == 'S' ? "<" + std::string(name) + flag + ">" : std::string();
}

TEST(StNames, WhenTextHoldsLiteralsAndComments_ThenOnlyIdentifiersAreVisited) {
  std::vector<std::string> names;
  for_each_identifier(
      "a := T#1h_2m + INT#-5 (* b *) + 16#FF; // c\n d.e := 'f $' g' + %IX0.0 + TOD#12:30:00;",
      [&](std::string_view name) { names.emplace_back(name); });
  EXPECT_EQ(names, (std::vector<std::string>{"a", "d", "e"}));
}

TEST(StNames, WhenCommentOrStringIsOpen_ThenTheTextEnds) {
  int count = 0;
  for_each_identifier("a (* b", [&](std::string_view) { ++count; });
  for_each_identifier("a 'b$", [&](std::string_view) { ++count; });
  EXPECT_EQ(count, 2);
}

TEST(StNames, WhenStepFlagIsUsed_ThenItIsReplaced) {
  EXPECT_EQ(replace_flags("IF S1.X AND (S2 . t > T#1s) THEN", mark), "IF <S1X> AND (<S2T> > T#1s) THEN");
}

TEST(StNames, WhenDottedNameIsNoStepFlag_ThenItStays) {
  for (const char* text :
       {"m.S1.X", "S1.Y", "S1.X1", "q.X", "S1 X", "S1", "S1[2].X", "S1.", "'S1.X'", "(*S1.X*)"}) {
    EXPECT_EQ(replace_flags(text, mark), text);
  }
}

}  // namespace
}  // namespace stepwright::lowering
