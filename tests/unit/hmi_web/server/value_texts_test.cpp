#include "hmi_web/server/value_texts.h"

#include <gtest/gtest.h>

namespace stepwright::server {
namespace {

using bytecode::ElementaryType;

TEST(DurationText, WhenItIsOfAnyLength_ThenItsUnitSaysSomething) {
  for (const auto& [seconds, text] :
       std::initializer_list<std::pair<double, const char*>>{{0, "0 s"},
                                                             {-1e-12, "0 s"},
                                                             {5e-9, "5 ns"},
                                                             {5e-6, "5 us"},
                                                             {0.004, "4 ms"},
                                                             {-0.0015, "-1.50 ms"},
                                                             {0.9999, "1.00 s"},
                                                             {2.5, "2.50 s"},
                                                             {30, "30 s"},
                                                             {59.97, "1 min"},
                                                             {90, "1 min 30 s"},
                                                             {7'500, "2 h 5 min"},
                                                             {100 * 86'400 + 4 * 3'600, "100 d 4 h"}})
    EXPECT_EQ(duration_text(seconds), text) << seconds;
}

class ValueTextsTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto add = [&](const char* name, ElementaryType type) {
      layout_.program.tags.push_back({name, "", ""});
      layout_.tags.push_back({type, 0, bytecode::kNoBit});
    };
    add("Main.level", ElementaryType::Real);
    add("Main.mode", ElementaryType::Int);
    add("Main.levels[2]", ElementaryType::Int);
    add("Main.delay", ElementaryType::Time);
    add("Main.hot", ElementaryType::Bool);
    add("Main.day", ElementaryType::Date);
    add("Main.clock", ElementaryType::Tod);
    add("Main.due", ElementaryType::Dt);
    add("Main.count", ElementaryType::Ulint);
    add("Main.balance", ElementaryType::Lint);
    layout_.program.tags[5].note.unit = "d";
    layout_.program.tags[8].note.unit = "pcs";
    layout_.program.enumerations = {{{7, "Auto"}}};
    layout_.program.tags[1].enumeration = 0;
    layout_.program.tags[0].note.unit = "m3";
    layout_.program.tags[0].note.decimals = 2;
    layout_.program.tags[3].note.unit = "s";
  }
  std::string text(const char* name, double value) const {
    protocol::TagNote level;
    level.name = "MAIN.level";
    level.unit = "l";
    protocol::TagNote levels;
    levels.name = "main.levels";
    levels.unit = "mm";
    return ValueTexts({level, levels}, {{"a1.level", "A1", "%", true}}, &layout_).of(name, value).text;
  }
  ProgramLayout layout_;
};

TEST_F(ValueTextsTest, WhenATagIsDescribed_ThenItsNumberHasUnitDecimalsAndName) {
  EXPECT_EQ(text("Main.level", 95), "95.00 l") << "the unit of the cell, the decimals of the declaration";
  EXPECT_EQ(text("level", -0.001), "0.00 l") << "by its last part; nothing has no sign";
  EXPECT_EQ(text("Main.mode", 7), "Auto");
  EXPECT_EQ(text("Main.mode", 8), "8") << "a value without a name";
  EXPECT_EQ(text("Main.levels[2]", 12), "12 mm") << "what is said of the array";
  EXPECT_EQ(text("Main.hot", 1), "TRUE");
  EXPECT_EQ(text("a1.level", 92.5), "92.5 %");
  EXPECT_EQ(text("Main.gone", 0.1), "0.1");
}

TEST_F(ValueTextsTest, WhenATimeHasADeclaredUnit_ThenItHasOneUnitOnly) {
  EXPECT_EQ(text("Main.delay", 20), "20 s");
  EXPECT_EQ(text("Main.delay", 0.004), "4 ms");
}

TEST_F(ValueTextsTest, WhenATagIsADate_ThenItIsToldAsPeopleWriteIt) {
  EXPECT_EQ(text("Main.day", 1767312000e9), "D#2026-01-02") << "without the unit that somebody has given it";
  EXPECT_EQ(text("Main.clock", 45000.5e9), "TOD#12:30:00.5");
  EXPECT_EQ(text("Main.due", 1767357000.25e9), "DT#2026-01-02-12:30:00.25");
}

TEST_F(ValueTextsTest, WhenAnIntegerHasMoreDigitsThanWereKept_ThenItIsToldAsRounded) {
  EXPECT_EQ(text("Main.count", 18446744073709551615.0), "≈ 18446744073709600000 pcs");
  EXPECT_EQ(text("Main.balance", -9007199254740994.0), "≈ -9007199254740990");
  EXPECT_EQ(text("Main.balance", -9007199254740992.0), "-9007199254740992");
}

}  // namespace
}  // namespace stepwright::server
