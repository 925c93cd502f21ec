// Values as texts and back, through the instructions.

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "tests/support/test_program.h"

namespace stepwright::vm {
namespace {

using bytecode::AddressMode;
using bytecode::MemType;
using bytecode::StringOpId;
using bytecode::TrapCode;
using support::one_program;
using support::TestProgram;
using writer::FunctionBuilder;

constexpr std::uint32_t kValue = 0;
constexpr std::uint32_t kBack = 8;
constexpr std::uint32_t kText = 16;  // STRING[40]
constexpr std::uint32_t kWide = 64;  // WSTRING[40]
constexpr std::uint32_t kBytes = 148;

std::string text_at(const TestProgram& program, std::uint32_t address) {
  std::string text;
  for (std::uint32_t i = 0; i < program.read<std::uint16_t>(address + 2); ++i)
    text += program.read<char>(address + 4 + i);
  return text;
}

void put_text(TestProgram& program, std::uint32_t address, const std::string& text) {
  program.write<std::uint16_t>(address + 2, static_cast<std::uint16_t>(text.size()));
  for (std::uint32_t i = 0; i < text.size(); ++i) program.write(address + 4 + i, text[i]);
}

struct Conversion {
  StringOpId from;  // for STRING
  StringOpId to;
  MemType type;
};

constexpr Conversion kBool{StringOpId::FromBoolS, StringOpId::ToBoolS, MemType::Bool};
constexpr Conversion kI64{StringOpId::FromI64S, StringOpId::ToI64S, MemType::I64};
constexpr Conversion kU64{StringOpId::FromU64S, StringOpId::ToU64S, MemType::I64};
constexpr Conversion kF32{StringOpId::FromF32S, StringOpId::ToF32S, MemType::F32};
constexpr Conversion kF64{StringOpId::FromF64S, StringOpId::ToF64S, MemType::F64};
constexpr Conversion kTime{StringOpId::FromTimeS, StringOpId::ToTimeS, MemType::I64};
constexpr Conversion kDate{StringOpId::FromDateS, StringOpId::ToDateS, MemType::I64};
constexpr Conversion kTod{StringOpId::FromTodS, StringOpId::ToTodS, MemType::I64};
constexpr Conversion kDt{StringOpId::FromDtS, StringOpId::ToDtS, MemType::I64};

StringOpId wide(StringOpId narrow) {
  return static_cast<StringOpId>(static_cast<std::uint8_t>(narrow) + 1);
}

// Writes the value as a text, takes the text over to a WSTRING and back, and reads both.
template <typename T>
void expect_text(const Conversion& conversion, T value, const std::string& expected) {
  TestProgram program(one_program(kBytes, [&](FunctionBuilder& f) {
    f.addr_this(kText);
    f.const_i32(40);
    f.string_op(StringOpId::InitS);
    f.addr_this(kWide);
    f.const_i32(40);
    f.string_op(StringOpId::InitW);
    f.addr_this(kWide);
    f.load(conversion.type, AddressMode::This, kValue);
    f.string_op(wide(conversion.from));
    f.addr_this(kText);
    f.addr_this(kWide);
    f.string_op(StringOpId::WstringToString);
    f.addr_this(kWide);
    f.string_op(StringOpId::ClearW);
    f.addr_this(kText);
    f.load(conversion.type, AddressMode::This, kValue);
    f.string_op(conversion.from);
    f.addr_this(kWide);
    f.addr_this(kText);
    f.string_op(StringOpId::StringToWstring);
    f.addr_this(kWide);
    f.string_op(wide(conversion.to));
    f.store(conversion.type, AddressMode::This, kBack);
    f.addr_this(kText);
    f.string_op(conversion.to);
    f.store(conversion.type, AddressMode::This, kBack);
  }));
  program.write(kValue, value);
  ASSERT_FALSE(program.run()) << expected;
  EXPECT_EQ(text_at(program, kText), expected);
  EXPECT_EQ(program.read<T>(kBack), value) << expected;
}

TrapCode read_as(StringOpId id, MemType type, const std::string& text) {
  TestProgram program(one_program(kBytes, [&](FunctionBuilder& f) {
    f.addr_this(kText);
    f.string_op(id);
    f.store(type, AddressMode::This, kBack);
  }));
  program.write<std::uint16_t>(kText, 40);
  put_text(program, kText, text);
  const TrapCode code = program.run().code;
  if (code != TrapCode::None) {
    EXPECT_EQ(program.read<std::uint64_t>(kBack), 0u);
  }
  return code;
}

// Whether the text has a value, by the test of `id`; it never traps.
bool is_value(StringOpId id, const std::string& text) {
  TestProgram program(one_program(kBytes, [&](FunctionBuilder& f) {
    f.addr_this(kText);
    f.string_op(bytecode::test_of(id));
    f.store(MemType::Bool, AddressMode::This, kBack);
  }));
  program.write<std::uint16_t>(kText, 40);
  put_text(program, kText, text);
  EXPECT_FALSE(program.run()) << text;
  return program.read<bool>(kBack);
}

TEST(StringConversion, Values_WhenWrittenAsTextAndRead_ThenComeBack) {
  expect_text(kBool, true, "TRUE");
  expect_text(kBool, false, "FALSE");
  expect_text<std::int64_t>(kI64, -123456789012, "-123456789012");
  expect_text<std::uint64_t>(kU64, 18446744073709551615u, "18446744073709551615");
  expect_text(kF32, 0.1f, "0.1");
  expect_text(kF64, 0.1, "0.1");
  expect_text(kF64, -1.25e100, "-1.25E+100");
  expect_text<std::int64_t>(kTime, 61'500'000'000, "T#1m1s500ms");
  expect_text<std::int64_t>(kDate, 951'782'400'000'000'000, "D#2000-02-29");
  expect_text<std::int64_t>(kTod, 45'000'500'000'000, "TOD#12:30:00.5");
  expect_text<std::int64_t>(kDt, 951'827'400'000'000'000, "DT#2000-02-29-12:30:00");
}

TEST(StringConversion, Texts_WhenTheyAreNoSuchLiteral_ThenTrap) {
  const Conversion all[] = {kBool, kI64, kU64, kF32, kF64, kTime, kDate, kTod, kDt};
  for (const Conversion& each : all) {
    EXPECT_EQ(read_as(each.to, each.type, "abc"), TrapCode::BadArgument);
    EXPECT_EQ(read_as(each.to, each.type, ""), TrapCode::BadArgument);
    EXPECT_EQ(read_as(each.to, each.type, "\xB2"), TrapCode::BadArgument);
  }
  EXPECT_EQ(read_as(StringOpId::ToU64S, MemType::I64, "-1"), TrapCode::BadArgument);
  EXPECT_EQ(read_as(StringOpId::ToF32S, MemType::F32, "1E39"), TrapCode::BadArgument);
  EXPECT_EQ(read_as(StringOpId::ToF32S, MemType::F32, "1E38"), TrapCode::None);
}

TEST(StringConversion, Texts_WhenTheyAreTested_ThenIsWhetherTheyCanBeRead) {
  const Conversion all[] = {kBool, kI64, kU64, kF32, kF64, kTime, kDate, kTod, kDt};
  const char* texts[] = {
      "",     "abc",  "TRUE", "-1",           "18446744073709551615", "1E38",
      "1E39", "T#1s", "\xB2", "D#2024-02-29", "TOD#12:00:00",         "DT#2024-02-29-12:00:00"};
  for (const Conversion& each : all) {
    int good = 0;
    for (const char* text : texts) {
      const bool reads = read_as(each.to, each.type, text) == TrapCode::None;
      EXPECT_EQ(is_value(each.to, text), reads) << text;
      good += reads ? 1 : 0;
    }
    EXPECT_GT(good, 0);
  }
}

TEST(StringConversion, Text_WhenLongerThanTheTarget_ThenIsCut) {
  TestProgram program(one_program(kBytes, [&](FunctionBuilder& f) {
    f.addr_this(kText);
    f.const_i32(3);
    f.string_op(StringOpId::InitS);
    f.addr_this(kText);
    f.const_i64(-12345);
    f.string_op(StringOpId::FromI64S);
  }));
  ASSERT_FALSE(program.run());
  EXPECT_EQ(text_at(program, kText), "-12");
}

TEST(StringConversion, WideCharacters_WhenAStringCannotHoldThem_ThenBecomeQuestionMarks) {
  TestProgram program(one_program(kBytes, [&](FunctionBuilder& f) {
    f.addr_this(kText);
    f.const_i32(10);
    f.string_op(StringOpId::InitS);
    f.addr_this(kText);
    f.addr_this(kWide);
    f.string_op(StringOpId::WstringToString);
  }));
  program.write<std::uint16_t>(kWide, 3);
  program.write<std::uint16_t>(kWide + 2, 3);
  program.write<std::uint16_t>(kWide + 4, 'a');
  program.write<std::uint16_t>(kWide + 6, 0x20AC);
  program.write<std::uint16_t>(kWide + 8, 0xE4);
  ASSERT_FALSE(program.run());
  EXPECT_EQ(text_at(program, kText), "a?\xE4");
}

}  // namespace
}  // namespace stepwright::vm
