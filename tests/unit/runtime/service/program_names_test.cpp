// Names and values as people write them, to requests and back.

#include "runtime/service/program_names.h"

#include <gtest/gtest.h>

#include "runtime/bytecode/writer/container_writer.h"
#include "runtime/image/image_bits.h"
#include "tests/support/sample_model.h"

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
