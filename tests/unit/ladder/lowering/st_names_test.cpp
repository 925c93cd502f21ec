#include "ladder/lowering/st_names.h"

#include <gtest/gtest.h>

#include <vector>

namespace stepwright::lowering {
namespace {

std::string mark(std::string_view name, char flag) {
  return name.front() == 'S' ? "<" + std::string(name) + flag + ">" : std::string();
}

std::string replaced(std::string_view text) {
  syntax::PieceReader reader;
  return replace_flags(reader, text, mark);
}

std::vector<std::string> names_of(std::string_view text) {
  syntax::PieceReader reader;
  std::vector<std::string> names;
  for_each_identifier(reader, text, [&](std::string_view name) { names.emplace_back(name); });
  return names;
}

TEST(StNames, WhenTextHoldsLiteralsAndComments_ThenOnlyIdentifiersAreVisited) {
  EXPECT_EQ(
      names_of("a := T#1h_2m + INT#-5 (* b *) + 16#FF; // c\n d.e := 'f $' g' + %IX0.0 + TOD#12:30:00;"),
      (std::vector<std::string>{"a", "d", "e"}));
}

TEST(StNames, WhenCommentsNestAndPragmasHoldAnything_ThenOnlyIdentifiersAreVisited) {
  EXPECT_EQ(names_of("(* (* x *) y *) a {b // c} + d /* it's e */ + f (* don't *)"),
            (std::vector<std::string>{"a", "d", "f"}));
}

TEST(StNames, WhenCommentOrStringIsOpen_ThenTheTextEnds) {
  EXPECT_EQ(names_of("a (* b"), std::vector<std::string>{"a"});
  EXPECT_EQ(names_of("a 'b$"), std::vector<std::string>{"a"});
}

TEST(StNames, WhenStepFlagIsUsed_ThenItIsReplaced) {
  EXPECT_EQ(replaced("IF S1.X AND (S2 . t > T#1s) THEN"), "IF <S1X> AND (<S2T> > T#1s) THEN");
}

TEST(StNames, WhenDottedNameIsNoStepFlag_ThenItStays) {
  for (const char* text : {"m.S1.X", "S1.Y", "S1.X1", "q.X", "S1 X", "S1", "S1[2].X", "S1.", "'S1.X'",
                           "(*S1.X*)", "(* (* *) S1.X *)", "/* ' */ 'S1.X'", "{S1.X}"}) {
    EXPECT_EQ(replaced(text), text);
  }
}

TEST(StNames, WhenCommentsStandInAFlag_ThenItIsReplaced) {
  EXPECT_EQ(replaced("S1 (* it's *) . /* x */ X := S2.X; // S1.X"), "<S1X> := <S2X>; // S1.X");
}

TEST(StNames, WhenAFlagIsAssigned_ThenItIsVisited) {
  syntax::PieceReader reader;
  std::string seen;
  for_each_written_flag(reader, "S1.X (* a *) := S2.X; f(Q => S3.T); '(*' <> S4.X; m.S5.X := 1; S6.Q ?= a;",
                        [&](std::string_view name, char flag) { seen += std::string(name) + flag + " "; });
  EXPECT_EQ(seen, "S1X S3T S6Q ");
}

TEST(StNames, WhenItIsAListOfVariables_ThenTheFirstNamesAreVisited) {
  syntax::PieceReader reader;
  std::string seen;
  for_each_first_name(reader, "lamp, motor.fault[i, j], (* x, *) %QX0.0, e",
                      [&](std::string_view name) { seen += std::string(name) + " "; });
  EXPECT_EQ(seen, "lamp motor e ");
}

TEST(StNames, WhenTheWordReturnIsAStatement_ThenItIsFound) {
  syntax::PieceReader reader;
  EXPECT_TRUE(holds_return(reader, "IF a THEN return; END_IF"));
  EXPECT_FALSE(holds_return(reader, "a := 'RETURN'; // RETURN"));
}

}  // namespace
}  // namespace stepwright::lowering
