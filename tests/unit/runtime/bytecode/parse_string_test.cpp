// Texts as values of strings.

#include "runtime/bytecode/reader/parse_string.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "runtime/bytecode/reader/read_value.h"

namespace stepwright::reader {
namespace {

using bytecode::ElementaryType;

Variable string_of(ElementaryType type, std::uint16_t capacity) {
  Variable variable;
  variable.type = type;
  variable.capacity = capacity;
  return variable;
}

// What the variable reads after the bytes were written; the code of the refusal else.
std::string after(const Variable& variable, std::string_view text) {
  const auto bytes = parse_string(variable, text);
  if (!bytes) return bytes.error().front().code;
  std::vector<std::byte> image(bytecode::string_bytes(variable.type, variable.capacity), std::byte{'x'});
  std::memcpy(image.data(), &variable.capacity, sizeof variable.capacity);
  EXPECT_LE(kStringLengthAt + bytes->size(), image.size());
  std::memcpy(image.data() + kStringLengthAt, bytes->data(), bytes->size());
  return read_text(variable, image);
}

TEST(ParseString, WhenTheTextFits_ThenItReadsAsItWasWritten) {
  const Variable narrow = string_of(ElementaryType::String, 10);
  EXPECT_EQ(after(narrow, "B 17"), "B 17");
  EXPECT_EQ(after(narrow, "'B 17'"), "B 17");
  EXPECT_EQ(after(narrow, "''"), "");
  EXPECT_EQ(after(narrow, ""), "");
  EXPECT_EQ(after(narrow, "'"), "'");
  EXPECT_EQ(after(narrow, "US$ 5"), "US$ 5") << "without quotes every character is itself";
  EXPECT_EQ(after(narrow, "'US$$ 5$'$41'"), "US$ 5'A");
  EXPECT_EQ(after(narrow, "Stra\u00DFe"), "Stra\u00DFe");
  EXPECT_EQ(after(narrow, "0123456789"), "0123456789");
  const Variable wide = string_of(ElementaryType::Wstring, 4);
  EXPECT_EQ(after(wide, "\"$20AC$\"\""), "\u20AC\"");
  EXPECT_EQ(after(wide, "\u20AC\U0001F600"), "\u20AC\U0001F600") << "three units";
  EXPECT_EQ(after(wide, "'a'"), "'a'") << "its literals have other quotes";
}

TEST(ParseString, WhenItDoesNotFit_ThenItIsRefusedWithItsLengthOrItsMistake) {
  const Variable narrow = string_of(ElementaryType::String, 4);
  EXPECT_EQ(after(narrow, "12345"), "R0058");
  EXPECT_EQ(after(narrow, "'$4'"), "R0058");
  EXPECT_EQ(after(narrow, "\u20AC"), "R0058");
  EXPECT_EQ(after(string_of(ElementaryType::Wstring, 1), "\U0001F600"), "R0058");
  const auto longer = parse_string(narrow, "12345", "X", {"MAIN.name", 0, 0});
  ASSERT_FALSE(longer);
  EXPECT_EQ(longer.error().front().message, "the text has 5 characters, the STRING has room for 4");
  EXPECT_EQ(longer.error().front().where.file, "MAIN.name");
}

}  // namespace
}  // namespace stepwright::reader
