#include "ladder/syntax/lexer.h"

#include <gtest/gtest.h>

#include "ladder/syntax/date_literal.h"
#include "ladder/syntax/direct_address.h"
#include "ladder/syntax/number.h"

namespace {

using namespace stepwright;
using syntax::TokenKind;

struct Lexed {
  source::SourceSet sources;
  source::NameTable names;
  std::vector<syntax::Token> tokens;
  result::Diagnostics diagnostics;
};

std::unique_ptr<Lexed> lex(const std::string& text, syntax::TextKind kind = syntax::TextKind::Written) {
  auto lexed = std::make_unique<Lexed>();
  syntax::intern_keywords(lexed->names);
  const source::FileId file = lexed->sources.add("t.st", text);
  source::DiagnosticSink sink(lexed->sources);
  lexed->tokens = syntax::lex(lexed->sources, file, kind, lexed->names, sink);
  lexed->diagnostics = sink.take();
  return lexed;
}

std::vector<TokenKind> kinds(const std::string& text) {
  std::vector<TokenKind> result;
  const auto lexed = lex(text);
  for (const auto& token : lexed->tokens) result.push_back(token.kind);
  return result;
}

TEST(Lexer, Symbols_WhenLongerOnesMatch_ThenTheLongestWins) {
  using enum TokenKind;
  EXPECT_EQ(kinds(":= => .. ** <> <= >= : = . * < >"),
            (std::vector<TokenKind>{Assign, Output, Range, Power, NotEqual, LessEqual, GreaterEqual, Colon,
                                    Equal, Dot, Star, Less, Greater, End}));
}

TEST(Lexer, Keywords_WhenWrittenInAnyCase_ThenAreReserved) {
  const auto lexed = lex("If END_IF iffy");
  EXPECT_TRUE(lexed->tokens[0].is(syntax::Keyword::If));
  EXPECT_TRUE(lexed->tokens[1].is(syntax::Keyword::EndIf));
  EXPECT_TRUE(lexed->tokens[2].is(TokenKind::Identifier));
}

TEST(Lexer, Numbers_WhenARangeFollows_ThenTheDotsAreNoFraction) {
  using enum TokenKind;
  EXPECT_EQ(kinds("1..3"), (std::vector<TokenKind>{Integer, Range, Integer, End}));
  EXPECT_EQ(kinds("1.5 2E3 1e-2"), (std::vector<TokenKind>{Real, Real, Real, End}));
}

TEST(Lexer, Comments_WhenNested_ThenAreSkippedAsAWhole) {
  EXPECT_EQ(kinds("a (* x (* y *) z *) b // c\n/* d */ e").size(), 4u);
  EXPECT_EQ(lex("(* (* *)")->diagnostics.size(), 1u);
}

TEST(Lexer, Pragma_WhenGenerated_ThenPositionsAreMapped) {
  const auto lexed = lex("a {@0:100}b c{@} d", syntax::TextKind::Generated);
  EXPECT_EQ(lexed->tokens[0].where.offset, 0u);
  EXPECT_EQ(lexed->tokens[1].where.offset, 100u);
  EXPECT_EQ(lexed->tokens[2].where.offset, 102u);
  EXPECT_EQ(lexed->tokens[3].where.offset, 17u);
  EXPECT_EQ(lex("a {@0:100}b")->tokens[1].where.offset, 10u);
}

TEST(Lexer, Bytes_WhenNotSt_ThenOneReportEachAndNoCrash) {
  const auto lexed = lex("a \x01 ? \xC3\xA4 b");
  EXPECT_EQ(lexed->diagnostics.size(), 3u);
  EXPECT_EQ(lexed->tokens.back().kind, TokenKind::End);
}

TEST(Lexer, Times_WhenPrefixed_ThenMarksBelongToThemBetweenDigits) {
  using enum TokenKind;
  EXPECT_EQ(kinds("D#2026-11-21-x TOD#12:30:00.5: DT#2026-11-21-08:00:00 LDATE#1970-01-02"),
            (std::vector<TokenKind>{Date, Minus, Identifier, TimeOfDay, Colon, DateAndTime, Date, End}));
  EXPECT_EQ(lex("LD#1970-01-02")->tokens[0].time_ns, 86'400'000'000'000);
}

TEST(Lexer, Addresses_WhenOpen_ThenTheStarBelongsToThem) {
  using enum TokenKind;
  EXPECT_EQ(kinds("%I* %QW* %MW0*2"), (std::vector<TokenKind>{Direct, Direct, Direct, Star, Integer, End}));
}

TEST(DateLiteral, Date_WhenWellFormed_ThenCountsFrom1970) {
  EXPECT_EQ(syntax::parse_date("1970-01-01"), 0);
  EXPECT_EQ(syntax::parse_date("1969-12-31"), -86'400'000'000'000);
  EXPECT_EQ(syntax::parse_date("2024-02-29"), 19'782 * 86'400'000'000'000);
  EXPECT_EQ(syntax::parse_time_of_day("23:59:59.999_999_999"),
            syntax::parse_time_of_day("23:59:59.999999999"));
  EXPECT_EQ(syntax::parse_time_of_day("01:01:01.25"), 3'661'250'000'000);
  EXPECT_EQ(syntax::parse_date_and_time("1970-01-02-00:00:01"), 86'401'000'000'000);
}

TEST(DateLiteral, Date_WhenIllFormed_ThenIsNone) {
  for (const char* text :
       {"", "2026-13-01", "2026-02-29", "1600-01-01", "2300-01-01", "2026-1", "2026-01-01-1"})
    EXPECT_FALSE(syntax::parse_date(text)) << text;
  for (const char* text : {"24:00:00", "1:60:00", "1:00", "1:00:00.", "1:00:00:00"})
    EXPECT_FALSE(syntax::parse_time_of_day(text)) << text;
}

TEST(Number, Duration_WhenWellFormed_ThenIsExact) {
  EXPECT_EQ(syntax::parse_duration("1d2h3m4s5ms6us7ns"), 93784005006007);
  EXPECT_EQ(syntax::parse_duration("-1.5s"), -1500000000);
  EXPECT_EQ(syntax::parse_duration("1h_30m"), 5400000000000);
  EXPECT_EQ(syntax::parse_duration("0.000000001s"), 1);
}

TEST(Number, Duration_WhenIllFormed_ThenIsNone) {
  for (const char* text :
       {"", "5", "1s2h", "1.5m2s", "1x", "1s1s", "99999999999d", "-", "1s_", "1d__2h", "1._5s", "1.5_s"})
    EXPECT_FALSE(syntax::parse_duration(text)) << text;
}

TEST(Number, Integer_WhenOutOf64BitsOrBadlyGrouped_ThenIsNone) {
  EXPECT_EQ(syntax::parse_integer("FFFF_FFFF_FFFF_FFFF", 16), 0xFFFFFFFFFFFFFFFFu);
  for (const char* text : {"18446744073709551616", "1__0", "_1", "1_", ""})
    EXPECT_FALSE(syntax::parse_integer(text, 10)) << text;
}

TEST(Number, Real_WhenBadlyGrouped_ThenIsNone) {
  EXPECT_EQ(syntax::parse_real("1_000.2_5E1_0"), 1000.25e10);
  for (const char* text : {"1__0.5", "1_.5", "1._5", "1.5_", "1.5_E3", "1.5E3_"})
    EXPECT_FALSE(syntax::parse_real(text)) << text;
}

TEST(DirectAddress, Parse_WhenWellFormed_ThenCountsInItsOwnSize) {
  EXPECT_EQ(naming::parse_direct_address("%IW1")->byte, 2u);
  EXPECT_EQ(naming::parse_direct_address("%md3")->byte, 12u);
  EXPECT_EQ(naming::parse_direct_address("%Q4.7")->bit, 7u);
  EXPECT_EQ(syntax::to_string(*naming::parse_direct_address("%qx4.7")), "%QX4.7");
  EXPECT_EQ(syntax::to_string(*naming::parse_direct_address("%ML2")), "%ML2");
}

TEST(DirectAddress, Parse_WhenIllFormed_ThenIsNone) {
  for (const char* text :
       {"%", "%I", "%X1", "%IX0_", "%IX0.8", "%IW1.2", "%IW", "%IW32768", "%IX65536.0", "%IB-1"})
    EXPECT_FALSE(naming::parse_direct_address(text)) << text;
}

}  // namespace
