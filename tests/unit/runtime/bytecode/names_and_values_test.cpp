// Variables by what people call them, and their values by literals.

#include <gtest/gtest.h>

#include <cstring>

#include "runtime/bytecode/reader/parse_value.h"
#include "runtime/bytecode/reader/read_value.h"
#include "runtime/bytecode/reader/resolve_name.h"
#include "runtime/bytecode/writer/container_writer.h"
#include "tests/support/sample_model.h"

namespace stepwright::reader {
namespace {

using bytecode::ElementaryType;
using L = support::SampleLayout;

ProgramInfo sample() {
  return ProgramInfo::read(writer::write_container(support::sample_model()).value()).value();
}

std::string hint_of(const ProgramInfo& info, const char* name) {
  const auto resolved = resolve_name(info, name);
  return resolved ? "" : resolved.error()[0].hint;
}

TEST(ResolveName, WhenAVariableIsNamed_ThenItIsFoundAsTheProgramSpellsIt) {
  const ProgramInfo info = sample();
  const auto element = resolve_name(info, "main.HISTORY[ 3 ]");
  ASSERT_TRUE(element);
  EXPECT_EQ(element->name, "MAIN.history[3]");
  EXPECT_EQ(element->variable.address, L::kMain + L::kHistory + 4);
  EXPECT_EQ(element->variable.type, ElementaryType::Int);
  EXPECT_TRUE(resolve_name(info, "MAIN.timer.PT"));
}

TEST(ResolveName, WhenAnAddressIsGiven_ThenItIsThatPlace) {
  const ProgramInfo info = sample();
  const auto bit = resolve_name(info, "%qx0.1");
  ASSERT_TRUE(bit);
  EXPECT_EQ(bit->variable.address, L::kOutputs);
  EXPECT_EQ(bit->variable.bit, 1);
  const auto word = resolve_name(info, "%IW1");
  ASSERT_TRUE(word);
  EXPECT_EQ(word->variable.address, 2u);
  EXPECT_EQ(bytecode::size_of(bytecode::mem_type(word->variable.type)), 2u);
  const auto plain = resolve_name(info, "%ID0");
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->variable.type, ElementaryType::Dword);
  EXPECT_FALSE(resolve_name(info, "%QX2.0"));
  EXPECT_EQ(hint_of(info, "%QW1"), "it has 2 bytes of them");
  EXPECT_FALSE(resolve_name(info, "%MX0.0"));
  EXPECT_FALSE(resolve_name(info, "%QX0.8"));
  EXPECT_FALSE(resolve_name(info, "%"));
}

TEST(ResolveName, WhenANameIsWrong_ThenTheHintSaysWhatWasMeant) {
  const ProgramInfo info = sample();
  EXPECT_EQ(hint_of(info, "history[2]"), "did you mean `MAIN.history[2]`?");
  EXPECT_EQ(hint_of(info, "MAIN.levle"), "did you mean `MAIN.level`?");
  EXPECT_EQ(hint_of(info, "MAIN.history"), "it has several values: name one of them, e.g. `MAIN.history[1]`");
  EXPECT_EQ(hint_of(info, "qqqqqqqqqqqqqqqqqqqqqqq"),
            "variables are named INSTANCE.variable, e.g. MAIN.level or MAIN.table[3]");
  const auto located = resolve_name(info, "nothing", "B0300", {"list", 4, 2});
  EXPECT_EQ(located.error()[0].code, "B0300");
  EXPECT_EQ(located.error()[0].where.line, 4u);
}

TEST(ResolveValues, WhenAnArrayOrAnInstanceIsNamed_ThenItIsAllValuesInside) {
  const ProgramInfo info = sample();
  const auto history = resolve_values(info, "main.history");
  ASSERT_TRUE(history);
  ASSERT_GT(history->size(), 2u);
  EXPECT_EQ(history->front().name, "MAIN.history[1]");
  EXPECT_EQ((*history)[2].name, "MAIN.history[3]");
  for (const NamedVariable& each : *history) EXPECT_TRUE(each.name.starts_with("MAIN.history[")) << each.name;
  EXPECT_EQ(resolve_values(info, "MAIN.timer")->size(), 3u);
  EXPECT_GT(resolve_values(info, "MAIN")->size(), history->size());
  EXPECT_EQ(resolve_values(info, "MAIN.level")->size(), 1u);
  EXPECT_FALSE(resolve_values(info, "MAIN.hist"));
}

TEST(ResolveName, WhenAPlaceIsNamed_ThenItResolvesToThatPlace) {
  const ProgramInfo info = sample();
  for (const Tag& tag : info.tags()) {
    const Variable& variable = tag.variable;
    if (bytecode::is_string(variable.type)) continue;
    const auto size = static_cast<std::uint8_t>(bytecode::size_of(bytecode::mem_type(variable.type)));
    const auto back = resolve_name(info, name_of_place(info, variable.address, variable.bit, size));
    ASSERT_TRUE(back) << tag.name;
    EXPECT_EQ(back->variable.address, variable.address) << tag.name;
    EXPECT_EQ(back->variable.bit, variable.bit) << tag.name;
  }
  EXPECT_EQ(name_of_place(info, L::kOutputs, 7, 1), "%QX0.7");
  EXPECT_EQ(name_of_place(info, 0, bytecode::kNoBit, 4), "%ID0");
  EXPECT_EQ(name_of_place(info, L::kMain + 3, bytecode::kNoBit, 2),
            "2 bytes at byte " + std::to_string(L::kMain + 3) + " of the image");
}

struct Literal {
  ElementaryType type;
  const char* text;
  bool good;
};

// What is accepted reads back as the same value.
TEST(ParseValue, WhenALiteralFitsItsType_ThenItIsItsBits) {
  using enum ElementaryType;
  const Literal literals[] = {{Bool, "TRUE", true},
                              {Bool, "false", true},
                              {Bool, "BOOL#1", true},
                              {Bool, "2", false},
                              {Sint, "-128", true},
                              {Sint, "128", false},
                              {Sint, "16#7F", true},
                              {Sint, "16#FF", false},
                              {Usint, "255", true},
                              {Usint, "256", false},
                              {Usint, "-1", false},
                              {Int, "INT#-5", true},
                              {Int, "DINT#5", false},
                              {Int, "-32769", false},
                              {Uint, "2#1010", true},
                              {Dint, "-2147483648", true},
                              {Dint, "1_000", true},
                              {Udint, "4294967295", true},
                              {Lint, "-9223372036854775808", true},
                              {Ulint, "18446744073709551615", true},
                              {Byte, "16#FF", true},
                              {Word, "WORD#16#ABCD", true},
                              {Word, "16#1_0000", false},
                              {Dword, "16#FFFF_FFFF", true},
                              {Lword, "16#FFFF_FFFF_FFFF_FFFF", true},
                              {Real, "3.5", true},
                              {Real, "1E40", false},
                              {Real, "REAL#-1", true},
                              {Lreal, "1E-300", true},
                              {Real, "three", false},
                              {Time, "T#1s500ms", true},
                              {Time, "LTIME#-5us", true},
                              {Time, "5", false},
                              {Date, "D#2024-02-29", true},
                              {Date, "D#2023-02-29", false},
                              {Tod, "TOD#12:30:00.5", true},
                              {Dt, "DT#2024-02-29-12:30:00", true},
                              {Char, "'a'", true},
                              {Wchar, "\"a\"", true},
                              {Char, "65", true},
                              {Char, "'ab'", false},
                              {String, "'text'", false},
                              {Int, "", false},
                              {Bool, "", false}};
  for (const Literal& literal : literals) {
    const Variable variable{literal.type, 0};
    const auto value = parse_value(variable, literal.text);
    EXPECT_EQ(value.has_value(), literal.good) << bytecode::name_of(literal.type) << " " << literal.text;
    if (!value) {
      EXPECT_EQ(value.error()[0].code, "R0058");
      EXPECT_FALSE(value.error()[0].hint.empty());
      continue;
    }
    std::vector<std::byte> image(8);
    std::memcpy(image.data(), &*value, sizeof *value);
    const std::uint32_t size = bytecode::size_of(bytecode::mem_type(literal.type));
    EXPECT_EQ(size == 8 ? 0 : *value >> 8 * size, 0u) << literal.text;
    const auto again = parse_value(variable, read_text(variable, image));
    ASSERT_TRUE(again) << read_text(variable, image);
    EXPECT_EQ(*again, *value) << literal.text;
  }
}

TEST(ParseValue, WhenItIsAnEnumeration_ThenItsNamesAndNumbersAreValues) {
  const Variable mode{ElementaryType::Int, 0, bytecode::kNoBit,
                      std::make_shared<const Enumerators>(Enumerators{{-1, "Off"}, {4, "Auto"}})};
  EXPECT_EQ(parse_value(mode, "auto").value(), 4u);
  EXPECT_EQ(parse_value(mode, "Mode#Off").value(), 0xFFFFu);
  EXPECT_EQ(parse_value(mode, "7").value(), 7u);
  EXPECT_EQ(parse_value(mode, "Fast").error()[0].hint, "its values are Off Auto");
}

}  // namespace
}  // namespace stepwright::reader
