#include "hmi_web/screens/part_check.h"

#include <gmock/gmock.h>

#include <string>

#include "hmi_web/drawing/drawing_file.h"
#include "ladder/driver/compile.h"

namespace stepwright::screens {
namespace {

using testing::HasSubstr;

constexpr const char* kProgram = R"(TYPE Mode : (Off, Hand, Auto); END_TYPE
PROGRAM Main
  VAR
    sensor AT %IX0.0 : BOOL;
    lamp AT %QX0.0 : BOOL;
    run : BOOL;
    n : INT;
    u : USINT;
    level : REAL;
    delay : TIME;
    name : STRING[5];
    day : DATE;
    mode : Mode;
  END_VAR
  VAR CONSTANT most : INT := 7; END_VAR
  lamp := run AND sensor AND n < most;
END_PROGRAM
)";

reader::ProgramInfo program() {
  const auto made = driver::compile({.texts = {{"main.st", kProgram}}});
  return reader::ProgramInfo::read(made.value().container).value();
}

// What is said of a part, with its line and hint; empty: it is sound.
std::string said(const std::string& attributes) {
  const auto drawn = drawing::read_drawing(
      "Mixer.svg", "<svg viewBox='0 0 9 9'>\n<g data-key='k' " + attributes + "><rect/></g></svg>");
  if (!drawn) return result::to_string(drawn.error());
  return result::to_string(check_parts(drawn->parts, program()));
}

struct Sound {
  const char* attributes;
};
class SoundPart : public testing::TestWithParam<Sound> {};
TEST_P(SoundPart, WhenItsValuesAreOfTheVariable_ThenNothingIsSaid) {
  EXPECT_EQ(said(GetParam().attributes), "");
}
INSTANTIATE_TEST_SUITE_P(
    All, SoundPart,
    testing::Values(Sound{"data-part='button' data-write='main.RUN' data-value='TRUE'"},
                    Sound{"data-part='button' data-write='Main.n' data-value='16#FF'"},
                    Sound{"data-part='button' data-write='Main.mode' data-value='Mode#Hand'"},
                    Sound{"data-part='button' data-write='Main.delay' data-value='T#2s'"},
                    Sound{"data-part='button' data-write='%QX0.0' data-value='1'"},
                    Sound{"data-part='button' data-write='Main.name' data-value='abc'"},
                    Sound{"data-part='choice' data-write='Main.name' data-values='A 1=First;A 2=Second'"},
                    Sound{"data-part='switch' data-write='Main.lamp'"},
                    Sound{"data-part='setpoint' data-write='Main.n' data-from='-32768' data-to='32767'"},
                    Sound{"data-part='setpoint' data-write='Main.delay' data-from='0.5' data-to='60'"},
                    Sound{"data-part='slider' data-write='Main.level' data-from='0.1' data-to='0.2'"},
                    Sound{"data-part='slider' data-write='Main.u' data-from='0' data-to='255'"},
                    Sound{"data-part='setpoint' data-write='Main.mode' data-from='0' data-to='2'"},
                    Sound{"data-part='choice' data-write='Main.mode' data-values='Off;hand=By hand;2'"},
                    Sound{"data-part='startstop' data-write='Main.run' data-stop='Main.lamp'"},
                    Sound{"data-part='button' data-write='Main.nothing' data-value='1'"},
                    Sound{"data-part='navigate' data-go='Other'"}));

struct Dead {
  const char* attributes;
  const char* said;
};
class DeadPart : public testing::TestWithParam<Dead> {};
TEST_P(DeadPart, WhenItCanNeverWrite_ThenAWarningSaysWhyAtItsLine) {
  const std::string text = said(GetParam().attributes);
  EXPECT_THAT(text, HasSubstr("Mixer.svg:2:2: warning: C0645: the "));
  EXPECT_THAT(text, HasSubstr(GetParam().said));
  EXPECT_THAT(text, HasSubstr("\n  hint: "));
}
INSTANTIATE_TEST_SUITE_P(
    All, DeadPart,
    testing::Values(
        Dead{"data-part='button' data-write='Main.n' data-value='abc'", "`abc` is no value of the type INT"},
        Dead{"data-part='button' data-write='Main.n' data-value='40000'", "no value of the type INT"},
        Dead{"data-part='button' data-write='Main.name' data-value='batch 7'",
             "the text has 7 characters, the STRING has room for 5"},
        Dead{"data-part='switch' data-write='Main.name'", "and Main.name is of the type STRING"},
        Dead{"data-part='button' data-write='Main.sensor' data-value='TRUE'",
             "Main.sensor, which is an input"},
        Dead{"data-part='button' data-write='%IX0.0' data-value='TRUE'", "which is an input"},
        Dead{"data-part='slider' data-write='Main.most' data-from='0' data-to='5'", "which is a constant"},
        Dead{"data-part='switch' data-write='Main.n'", "switch 'k' writes TRUE and FALSE, and Main.n"},
        Dead{"data-part='startstop' data-write='Main.level'", "pair 'k' writes TRUE and FALSE"},
        Dead{"data-part='startstop' data-write='Main.run' data-stop='Main.n'", "cannot write TRUE to Main.n"},
        Dead{"data-part='startstop' data-write='Main.run' data-stop='Main.sensor'", "which is an input"},
        Dead{"data-part='setpoint' data-write='Main.run' data-from='0' data-to='5'",
             "set point 'k' writes numbers, and Main.run is of the type BOOL"},
        Dead{"data-part='setpoint' data-write='Main.name' data-from='0' data-to='5'", "of the type STRING"},
        Dead{"data-part='slider' data-write='Main.day' data-from='0' data-to='5'", "of the type DATE"},
        Dead{"data-part='slider' data-write='Main.u' data-from='-1' data-to='5'",
             "has the range -1 to 5, and Main.u of the type USINT does not take all of it\n"
             "  hint: data-from and data-to within 0 to 255"},
        Dead{"data-part='setpoint' data-write='Main.n' data-from='0' data-to='100000'",
             "the range 0 to 100000"},
        Dead{"data-part='setpoint' data-write='Main.n' data-from='0.2' data-to='0.8'", "takes whole numbers"},
        Dead{"data-part='setpoint' data-write='Main.mode' data-from='0' data-to='3'", "within 0 to 2"},
        Dead{"data-part='setpoint' data-write='Main.level' data-from='0' data-to='1e40'", "of the type REAL"},
        Dead{"data-part='choice' data-write='Main.mode' data-values='Off;Hend=By hand'",
             "cannot write Hend to Main.mode: `Hend` is no value"},
        Dead{"data-part='choice' data-write='Main.mode' data-values='Off;Hend=By hand'",
             "did you mean 'Hand'?"},
        Dead{"data-part='button' data-write='Main.mode' data-value='7'",
             "writes 7 to Main.mode, which has no such value\n  hint: its values are Off Hand Auto"}));

TEST(PartCheck, WhenSeveralValuesAreWrong_ThenEachIsTold) {
  const std::string text = said("data-part='choice' data-write='Main.n' data-values='1;two;three;4'");
  EXPECT_THAT(text, HasSubstr("`two`"));
  EXPECT_THAT(text, HasSubstr("`three`"));
}

}  // namespace
}  // namespace stepwright::screens
