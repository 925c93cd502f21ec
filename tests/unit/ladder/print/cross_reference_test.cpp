#include "ladder/print/cross_reference.h"

#include <gtest/gtest.h>

#include "ladder/print/text_uses.h"

namespace stepwright::print {
namespace {

std::string uses_of(const std::string& st) {
  std::string text;
  for (const TextUse& use : TextUses().of(st)) text += use.name + (use.write ? "=" : "") + " ";
  return text;
}

TEST(TextUses, WhenStatementsAssign_ThenTargetsAreWrittenAndTheRestIsRead) {
  EXPECT_EQ(uses_of("a := b + c;"), "a= b c ");
  EXPECT_EQ(uses_of("a.x[i].y := b.z;"), "a= i b ");
  EXPECT_EQ(uses_of("p^ := 1; r ?= q;"), "p= r= q ");
  EXPECT_EQ(uses_of("FOR i := 1 TO n DO s := s + i; END_FOR;"), "i= n s= s i ");
  EXPECT_EQ(uses_of("%QX0.0 := %IX0.1;"), "%QX0.0= %IX0.1 ");
}

TEST(TextUses, WhenPathsAreFixed_ThenTheyAreWholeAndTheirPlacesAreKnown) {
  const auto place = [](const std::string& st) {
    const TextUse use = TextUses().of(st).front();
    return use.path + " " + std::to_string(use.line) + ":" + std::to_string(use.column) + "+" +
           std::to_string(use.length);
  };
  EXPECT_EQ(place("a.b := 1;"), "a.b 1:1+3");
  EXPECT_EQ(place("\n  a [ -1 , 2 ] . c := 1;"), "a[-1][2].c 2:3+16");
  EXPECT_EQ(place("a[i].b := 1;"), "a 1:1+1");
  EXPECT_EQ(place("a.b[i] := 1;"), "a.b 1:1+3");
  EXPECT_EQ(place("(* \u00e4 *) p^.x := 1;"), "p 1:9+1");
  EXPECT_EQ(place("w.3 := TRUE;"), "w 1:1+1");
  for (const char* text : {"a[1", "a[", "a[-", "a.", "a[1,", "a[1]."}) EXPECT_NO_FATAL_FAILURE(place(text));
}

TEST(TextUses, WhenBlocksAreCalled_ThenFormalNamesAreNoVariables) {
  EXPECT_EQ(uses_of("t(IN := start, PT := T#5s, Q => lamp);"), "t= start lamp= ");
  EXPECT_EQ(uses_of("x := (a := b);"), "x= b ");
}

TEST(TextUses, WhenTextHoldsCommentsAndStrings_ThenTheyAreNoVariables) {
  EXPECT_EQ(uses_of("a := 'b := c'; (* d := e *) // f := g"), "a= ");
}

TEST(TextUses, WhenTextIsBroken_ThenItEnds) {
  for (const char* text : {"", "a", "a.", "a[", "a[b", "(", ")", "a :=", "'", "(*", "a^^^", "%", "a.b[.c"})
    EXPECT_NO_FATAL_FAILURE(uses_of(text));
}

TEST(CrossReference, WhenRungsShareVariables_ThenWritersAndReadersAreFound) {
  graphic::LadderProgram program;
  graphic::Rung rung;
  rung.condition = graphic::contact("a");
  rung.coils = {{graphic::CoilKind::Normal, "m"}};
  program.rungs.push_back(rung);
  rung.condition =
      graphic::all({graphic::contact("M"), graphic::compare("s", graphic::CompareOp::Less, "top")});
  rung.coils = {{graphic::CoilKind::Set, "q"}};
  program.rungs.push_back(rung);
  graphic::Sheet sheet{"PROGRAM", "p"};
  sheet.variables = {{"m", "BOOL"}, {"s", "INT"}, {"top", "INT"}, {"unused", "INT"}};
  sheet.body = program;
  const auto uses = cross_reference(sheet);
  ASSERT_EQ(uses.size(), 5U);
  EXPECT_EQ(uses[1].name, "m");
  EXPECT_EQ(joined(uses[1].written), "1");
  EXPECT_EQ(joined(uses[1].read), "2");
  EXPECT_EQ(joined(uses[4].read), "2");
  const graphic::LadderNotes notes = ladder_notes(uses);
  EXPECT_EQ(notes.contacts.at("M"), "←1");
  EXPECT_EQ(notes.coils.at("M"), "→2");
  EXPECT_EQ(notes.contacts.count("A"), 0U);
}

}  // namespace
}  // namespace stepwright::print
