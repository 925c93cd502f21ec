#include "ladder/syntax/piece.h"

#include <gtest/gtest.h>

#include "ladder/syntax/blank.h"

namespace stepwright::syntax {
namespace {

Piece read(std::string_view text, PieceKind kind) {
  PieceReader reader;
  return reader.read(text, kind);
}

TEST(Piece, WhenAnExpressionIsWhole_ThenItIsKnownWhetherItIsAnOperand) {
  for (const char* text : {"a", "m.x[i + 1, 2].y^", "%IX0.0", "w.%X3", "f(a OR b, c := 1)", "16#FF", "T#1s",
                           "'a OR b'", "INT#5", "Color#Red", "TRUE", "a (* OR b *)", "{p} a // OR b"})
    EXPECT_TRUE(read(text, PieceKind::Expression).is_operand) << text;
  for (const char* text : {"a OR b", "NOT a", "-5", "(a) OR (b)", "a = 'x'", "f(a) & g(b)"}) {
    EXPECT_TRUE(read(text, PieceKind::Expression).is_whole) << text;
    EXPECT_FALSE(read(text, PieceKind::Expression).is_operand) << text;
  }
}

TEST(Piece, WhenSomethingStandsBeforeOrBehindIt_ThenItIsNotWhole) {
  for (const char* text : {"a) OR (b", "a; b := c", "a, b", "a := b", "a b", "(a", "a (*", "'a", "{a", "",
                           " ", "(* a *)", "a => b", "a THEN", "a; ", "a $ b"})
    EXPECT_FALSE(read(text, PieceKind::Expression).is_whole) << text;
  for (const char* text : {"x := 1; END_IF; y := 2; IF a THEN z := 3;", "END_IF", "x := 1; ELSE y := 2",
                           "x :=", "IF a THEN x := 1;", "x := 1; (* y", "l: x := 1;", "END_ACTION x := 1;"})
    EXPECT_FALSE(read(text, PieceKind::StatementList).is_whole) << text;
  for (const char* text : {"f(a)", "a OR b", "5", "'a'", "(a)", "a := b", "TRUE", "NOT a", "a, b"})
    EXPECT_FALSE(read(text, PieceKind::Variable).is_whole) << text;
  for (const char* text : {"a.b", "a b", "5", "", "a := 1", "a(b)"})
    EXPECT_FALSE(read(text, PieceKind::Word).is_whole) << text;
}

TEST(Piece, WhenStatementsVariablesAndWordsAreWhole_ThenTheyPass) {
  for (const char* text : {"", ";", "x := 1", "x := 1;", "IF a THEN x := 1; END_IF", "// x\n", "f(a);",
                           "x := '//'; {attribute // x} y := 2; (* a (* b *) ' *)"})
    EXPECT_TRUE(read(text, PieceKind::StatementList).is_whole)
        << text << ": " << read(text, PieceKind::StatementList).fault;
  for (const char* text : {"a", "m.x[i]", "p^", "%QX0.0", "w.%X3", "w.3", "STEP", "__W0_"})
    EXPECT_TRUE(read(text, PieceKind::Variable).is_whole) << text;
  for (const char* text : {"a", "AND", "MOD", "__W0_"})
    EXPECT_TRUE(read(text, PieceKind::Word).is_whole) << text;
}

TEST(Piece, WhenTheFaultStandsBehindOtherCharacters_ThenItsByteIsCounted) {
  const Piece piece = read("(* ä *) a b", PieceKind::Expression);
  EXPECT_FALSE(piece.is_whole);
  EXPECT_EQ(piece.fault_at, 11U);
}

TEST(PieceLine, WhenTextHasCommentsAndLines_ThenTokensKeepTheirBytes) {
  PieceReader reader;
  const std::string text =
      "a := '(* // {'; // it's\nb (* (* x *) \r\n ' *) := \"/*\"; /* 'y */ {@1:2} {p // q}\n c := 1;";
  const std::string line = reader.line(text);
  ASSERT_EQ(line.size(), text.size());
  EXPECT_EQ(line.find_first_of("\r\n"), std::string::npos);
  const std::vector<Token> written = reader.tokens(text);
  const std::vector<Token> found = reader.tokens(line);
  ASSERT_EQ(found.size(), written.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(begin_of(found[i], line), begin_of(written[i], text));
    EXPECT_EQ(found[i].text, written[i].text);
  }
  EXPECT_NE(line.find("{@1:2} {p // q}"), std::string::npos);
  EXPECT_EQ(line.find("it's"), std::string::npos);
  EXPECT_EQ(reader.bare_line("a {@1:2} // b"), "a            ");
}

TEST(PieceLine, WhenACommentHasNoEnd_ThenItStays) {
  PieceReader reader;
  EXPECT_EQ(reader.line("a (* b\n c"), "a (* b  c");
}

TEST(Blank, WhenItBegins_ThenItsKindAndEndAreKnown) {
  EXPECT_EQ(blank_at("(* (* *) *)x", 0).end, 11U);
  EXPECT_EQ(blank_at("/* (* */x", 0).end, 8U);
  EXPECT_EQ(blank_at("// a\nb", 0).end, 4U);
  EXPECT_EQ(blank_at("{{ } }}x", 0).end, 7U);
  EXPECT_EQ(blank_at(" \t\n x", 0).end, 4U);
  EXPECT_EQ(blank_at("x", 0).kind, BlankKind::None);
  EXPECT_EQ(blank_at("", 0).kind, BlankKind::None);
  EXPECT_FALSE(blank_at("(* (* *)", 0).closed);
  EXPECT_FALSE(blank_at("{a", 0).closed);
}

}  // namespace
}  // namespace stepwright::syntax
