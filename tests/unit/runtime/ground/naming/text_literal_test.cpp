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

}  // namespace
}  // namespace stepwright::naming
