#include "runtime/ground/result/utf8_place.h"

#include <gtest/gtest.h>

#include <string>

namespace stepwright::result {
namespace {

std::string place(std::string_view text) {
  const auto broken = place_of_no_utf8("a.csv", text);
  return broken ? broken->file + ":" + std::to_string(broken->line) + ":" + std::to_string(broken->column)
                : "none";
}

TEST(Utf8Place, WhenAllOfItIsUtf8_ThenThereIsNone) {
  EXPECT_EQ(place(""), "none");
  EXPECT_EQ(place("plain\r\ntext"), "none");
  EXPECT_EQ(place("\xEF\xBB\xBF°C Ż € 😀 \xF4\x8F\xBF\xBF"), "none");
}

TEST(Utf8Place, WhenAByteIsNone_ThenItsLineAndItsColumnInCharactersAreTold) {
  EXPECT_EQ(place("name,unit\nMain.level,\xB0"
                  "C\n"),
            "a.csv:2:12")
      << "Latin-1";
  EXPECT_EQ(place("°,\xB0"), "a.csv:1:3");
  EXPECT_EQ(place("\xFF\xFEn"), "a.csv:1:1") << "UTF-16";
  EXPECT_EQ(place("a\xE2\x82"), "a.csv:1:2") << "half a character at the end";
  for (const char* text :
       {"\xC0\x80", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xF0\x80\x80\x80", "\x80"})
    EXPECT_EQ(place(text), "a.csv:1:1");
}

}  // namespace
}  // namespace stepwright::result
