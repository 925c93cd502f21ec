// Characters of string literals.

#include "runtime/ground/naming/text_literal.h"

#include <gtest/gtest.h>

namespace stepwright::naming {
namespace {

TEST(TextLiteral, Escapes_WhenWellFormed_ThenAreTheirCharacters) {
  TextMistake mistake;
  EXPECT_EQ(parse_text("a$$b$'c$41$n\"", TextWidth::Single, mistake), u"a$b'cA\n\"");
  EXPECT_EQ(parse_text("$20AC$\"'", TextWidth::Double, mistake), u"\u20AC\"'");
  EXPECT_EQ(parse_text("\xC3\xA4\xE4", TextWidth::Single, mistake), u"\u00E4\u00E4");
  EXPECT_EQ(parse_text("\xF0\x9F\x98\x80", TextWidth::Double, mistake), u"\xD83D\xDE00");
}

TEST(TextLiteral, Escapes_WhenIllFormed_ThenTheirPlaceIsKnown) {
  TextMistake mistake;
  for (const char* text : {"ab$", "ab$4", "ab$\"", "ab$x1", "ab\xE2\x82\xAC"}) {
    EXPECT_FALSE(parse_text(text, TextWidth::Single, mistake)) << text;
    EXPECT_EQ(mistake.offset, 2u) << text;
  }
}

TEST(LiteralText, WhenATextHasControlCharacters_ThenTheyAreWrittenAsInLiterals) {
  EXPECT_EQ(literal_text("a\x1B[31mred\n  Main.fake = TRUE", TextWidth::Single),
            "a$1B[31mred$N  Main.fake = TRUE");
  EXPECT_EQ(literal_text("5$ \xC2\xB0\r\t\f\x7F\xC2\x9B", TextWidth::Single), "5$$ \xC2\xB0$R$T$P$7F$9B");
  EXPECT_EQ(literal_text("\xE2\x82\xAC\x1B", TextWidth::Double), "\xE2\x82\xAC$001B");
}

}  // namespace
}  // namespace stepwright::naming
