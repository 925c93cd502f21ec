// Names and values as people write them, to requests and back.

#include "runtime/service/program_names.h"

#include <gtest/gtest.h>

#include "runtime/bytecode/writer/container_writer.h"
#include "runtime/image/image_bits.h"
#include "tests/support/sample_model.h"
#include "tests/support/test_program.h"

namespace stepwright::service {
namespace {

using L = support::SampleLayout;

class ProgramNamesTest : public testing::Test {
 protected:
  const std::string digest_ = std::string(64, 'a');
  const reader::ProgramInfo info_ =
      reader::ProgramInfo::read(writer::write_container(support::sample_model()).value()).value();
  const ProgramNames names_{digest_, info_};
};

TEST_F(ProgramNamesTest, WhenAValueIsNamed_ThenItsBitsNameTheProgramAndBothAreSpelledAsInIt) {
  const auto pump = names_.value("%qx0.1", "true");
  ASSERT_TRUE(pump) << result::to_string(pump.error());
  EXPECT_EQ(pump->bits, (host::ProgramBits{digest_, {L::kOutputs, 0b10, 0b10}}));
  EXPECT_EQ(pump->text, "TRUE");
  const auto number = names_.value("main.HISTORY[3]", "16#FF");
  ASSERT_TRUE(number);
  EXPECT_EQ(number->name, "MAIN.history[3]");
  EXPECT_EQ(number->bits, (host::ProgramBits{digest_, {L::kMain + L::kHistory + 4, 0xFFFF, 0xFF}}));
  EXPECT_EQ(number->text, "255");
  EXPECT_EQ(names_.written("main.HISTORY[3]", "16#FF")->block,
            (host::BlockWrite{digest_, {number->bits.bits}}));
}

TEST_F(ProgramNamesTest, WhenNameOrValueIsWrong_ThenEachHasItsCode) {
  EXPECT_EQ(names_.value("MAIN.levle", "1").error().front().code, "R0057");
  EXPECT_EQ(names_.forceable("MAIN.levle").error().front().code, "R0057");
  EXPECT_EQ(names_.as_forced("MAIN.levle", "1").error().front().code, "R0057");
  const auto wrong = names_.value("main.count", "much");
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().front().code, "R0058");
  EXPECT_EQ(wrong.error().front().where.file, "MAIN.count");
}

// A program with a text of up to 20 characters behind eight other bytes.
reader::ProgramInfo program_with_a_text() {
  constexpr std::uint32_t kCapacity = 20;
  const std::uint32_t size = bytecode::string_bytes(bytecode::ElementaryType::String, kCapacity);
  writer::ContainerModel model = support::one_program(8 + size, [](auto&) {});
  const auto type = model.add_type(writer::string_type(bytecode::ElementaryType::String, kCapacity));
  model.symbols.push_back({.name = "label", .type = type, .address = 8, .direct_address = {}});
  return reader::ProgramInfo::read(writer::write_container(model).value()).value();
}

TEST(WrittenConstant, WhenItIsWrittenOrForced_ThenItIsRefused) {
  writer::ContainerModel model = support::one_program(8, [](auto&) {});
  const auto type = model.add_type(writer::elementary(bytecode::ElementaryType::Int));
  model.symbols.push_back({.name = "limit",
                           .type = type,
                           .address = 0,
                           .flags = bytecode::kSymbolConstant,
                           .direct_address = {}});
  model.symbols.push_back({.name = "level", .type = type, .address = 2, .direct_address = {}});
  const auto info = reader::ProgramInfo::read(writer::write_container(model).value()).value();
  const ProgramNames names(std::string(64, 'c'), info);
  EXPECT_TRUE(names.written("level", "7"));
  for (const auto& refused : {names.written("LIMIT", "7").error(), names.value("limit", "7").error(),
                              names.as_forced("limit", "7").error()}) {
    EXPECT_EQ(refused.front().code, "R0058");
    EXPECT_EQ(refused.front().message, "`limit` is a constant of the program");
  }
  EXPECT_TRUE(names.forceable("limit")) << "what was forced before can be released";
}

TEST(WrittenText, WhenItIsWritten_ThenItsPartsAreTheWholeTextAndNothingElse) {
  const std::string digest(64, 'b');
  const reader::ProgramInfo info = program_with_a_text();
  const ProgramNames names(digest, info);
  std::vector<std::byte> image(8 + 24, std::byte{0xEE});
  image[8] = std::byte{20};
  image[9] = std::byte{0};
  for (const std::string text : {"line 2: fill, close", "short", ""}) {
    const auto written = names.written("LABEL", text);
    ASSERT_TRUE(written) << result::to_string(written.error());
    EXPECT_EQ(written->name, "label");
    EXPECT_EQ(written->text, text);
    EXPECT_EQ(written->block.program_digest, digest);
    for (const host::ImageBits& part : written->block.parts)
      ASSERT_EQ(image::write_bits(image, part), image::BitsStatus::Done);
    EXPECT_EQ(names.read("label", image).value(), text);
    EXPECT_EQ(image[7], std::byte{0xEE});
    EXPECT_EQ(image[8], std::byte{20}) << "its capacity stays";
    EXPECT_EQ(image[31], std::byte{0xEE}) << "and what lies behind the longest of them";
  }
  EXPECT_EQ(names.written("label", std::string(21, 'x')).error().front().code, "R0058");
  EXPECT_EQ(names.value("label", "short").error().front().code, "R0058") << "it is never forced";
}

// What is told of a force is what it was asked for, whoever tells it.
TEST_F(ProgramNamesTest, WhenAValueIsForced_ThenItIsToldByTheSameNameAndText) {
  const std::pair<const char*, const char*> wanted[] = {
      {"%QX0.1", "TRUE"}, {"MAIN.history[3]", "-7"}, {"MAIN.level", "0.1"}, {"MAIN.timer.PT", "T#1s500ms"}};
  for (const auto& [name, text] : wanted) {
    const auto value = names_.value(name, text);
    ASSERT_TRUE(value) << name;
    image::Force force;
    ASSERT_EQ(image::to_force(value->bits.bits, 1'000, force), image::BitsStatus::Done) << name;
    force.end_ns = image::kNoEnd;
    const ForcedValue told = names_.forced(force);
    EXPECT_EQ(told.text(), value->text) << name;
    EXPECT_FALSE(told.ends);
    const auto as_forced = names_.as_forced(name, text);
    ASSERT_TRUE(as_forced) << name;
    EXPECT_EQ(as_forced->name, told.name);
    EXPECT_EQ(as_forced->text(), value->text);
    EXPECT_TRUE(as_forced->ends);
    EXPECT_EQ(names_.read(name, told.image).value(), value->text);
    EXPECT_EQ(names_.forceable(name)->bits.bits.mask, value->bits.bits.mask);
  }
}

}  // namespace
}  // namespace stepwright::service
