#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "hmi_web/drawing/drawing_file.h"

namespace stepwright::drawing {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

result::Result<Drawing> with_parts(const std::string& inside, const std::string& root = "") {
  return read_drawing("a.svg", "<svg viewBox='0 0 9 9' " + root + ">\n" + inside + "</svg>");
}

TEST(Parts, WhenTheyWrite_ThenWhatTheyMayIsRead) {
  const auto drawn = with_parts(
      "<g data-part='setpoint' data-key='a' data-write='Main.level' data-from='-5' data-to='12.5'/>\n"
      "<g data-part='choice' data-key='b' data-write='Main.mode' data-values='0 = Off; 2=By hand; 3'/>"
      "<g data-part='startstop' data-key='c' data-write='Main.go' data-stop='Main.halt' "
      "data-confirm='Sure?'/>"
      "<g data-part='trend' data-tags='Main.level; Main.flow'/>",
      "data-least='operator'");
  ASSERT_TRUE(drawn) << result::to_string(drawn.error());
  ASSERT_EQ(drawn->parts.size(), 4u);
  EXPECT_EQ(drawn->parts[0].least, -5);
  EXPECT_EQ(drawn->parts[0].most, 12.5);
  EXPECT_EQ(drawn->parts[0].where.line, 2u);
  EXPECT_THAT(drawn->parts[1].values, ElementsAre(Pair("0", "Off"), Pair("2", "By hand"), Pair("3", "3")));
  EXPECT_EQ(drawn->parts[2].stop, "Main.halt");
  EXPECT_EQ(drawn->parts[2].confirm, "Sure?");
  EXPECT_EQ(drawn->least, "operator");
  EXPECT_EQ(drawn->names.size(), 6u) << "what parts write and show can be looked up, too";
}

TEST(Parts, WhenSomethingIsMissing_ThenItIsToldWithItsPlaceAndAWay) {
  const auto told = [](const std::string& part) {
    const auto drawn = with_parts("<g " + part + "/>");
    return drawn ? std::string("nothing") : result::to_string(drawn.error());
  };
  EXPECT_THAT(told("data-part='lever'"), HasSubstr("there is no part lever"));
  EXPECT_THAT(told("data-part='button' data-write='a' data-value='1'"), HasSubstr("needs data-key"));
  EXPECT_THAT(told("data-part='button' data-key='a b' data-write='a' data-value='1'"),
              HasSubstr("needs data-key"));
  EXPECT_THAT(told("data-part='button' data-key='a' data-value='1'"), HasSubstr("needs data-write"));
  EXPECT_THAT(told("data-part='button' data-key='a' data-write='a'"), HasSubstr("needs data-value"));
  EXPECT_THAT(told("data-part='slider' data-key='a' data-write='a' data-to='9'"),
              HasSubstr("need their range"));
  EXPECT_THAT(told("data-part='slider' data-key='a' data-write='a' data-from='9' data-to='9'"),
              HasSubstr("data-from below data-to"));
  EXPECT_THAT(told("data-part='choice' data-key='a' data-write='a' data-values='0=Off'"),
              HasSubstr("two or more"));
  EXPECT_THAT(told("data-part='navigate'"), HasSubstr("data-go"));
  EXPECT_THAT(told("data-least='king'"), HasSubstr("is no role"));
  EXPECT_THAT(told("data-part='trend' data-tags='a b'"), HasSubstr("names no variable"));
  const auto twice = with_parts(
      "<g data-part='switch' data-key='a' data-write='b'/>\n"
      "<g data-part='switch' data-key='a' data-write='c'/>");
  ASSERT_FALSE(twice);
  EXPECT_EQ(twice.error()[0].where.line, 3u);
  EXPECT_THAT(twice.error()[0].message, HasSubstr("two parts have the data-key a"));
}

TEST(Parts, WhenACopyOfAFaceLeavesAFieldEmpty_ThenItsNamesSayOfWhichCopyTheyAre) {
  const auto drawn = with_parts(
      R"(<g data-symbol="face" data-params='{"face":"Pump","key":"p3"}'><g><text data-text="{pump}.speed"/>)"
      R"(<text data-text="Main.level"/></g></g><text data-text="{pump}.speed"/>)");
  ASSERT_TRUE(drawn) << result::to_string(drawn.error());
  ASSERT_EQ(drawn->names.size(), 3u);
  EXPECT_EQ(drawn->names[0].copy, R"({"face":"Pump","key":"p3"})");
  EXPECT_EQ(drawn->names[1].copy, "");
  EXPECT_EQ(drawn->names[2].copy, "") << "it stands in no copy";
}

TEST(Parts, WhenAnOperatorPartOfTheEditorIsNotFilledIn_ThenAWarningNamesItAtItsLine) {
  const auto told = [](const std::string& symbol, const std::string& more = "") {
    const auto drawn = with_parts("<g data-symbol='" + symbol + "' " + more + "><rect/></g>");
    return drawn ? result::to_string(drawn->warnings) : result::to_string(drawn.error());
  };
  const std::string button =
      told("button", R"(data-params='{"label":"Halt \u00e4","key":"p1","literal":"TRUE"}')");
  EXPECT_THAT(button, HasSubstr("a.svg:2:2: warning: C0647: the button 'Halt \u00e4' writes nothing"));
  EXPECT_THAT(button, HasSubstr("\n  hint: 'Writes' in its properties"));
  EXPECT_THAT(told("setpoint", R"(data-params='{"key":"p2","write":"Main.level"}')"),
              HasSubstr("the set point 'p2' writes nothing\n  hint: the value, the values or the range"));
  EXPECT_THAT(told("navigate", R"(data-params='{"key":"p3"}')"), HasSubstr("'p3' leads nowhere"));
  EXPECT_THAT(told("switch", "data-params='[1'"), HasSubstr("C0647")) << "whatever stands there";
  EXPECT_EQ(told("button", R"(data-part='button' data-key='a' data-write='b' data-value='1')"), "");
  EXPECT_EQ(told("tank"), "");
  EXPECT_EQ(told("trend"), "");
}

TEST(Parts, WhenADrawingIsReadAgain_ThenItIsTheSame) {
  const auto once = with_parts(
      "<defs><linearGradient id='g'/></defs><rect fill='url(#g)'/><text> a  b </text>"
      "<image href='data:image/png;base64,AAA='/><use href='#g'/>");
  ASSERT_TRUE(once) << result::to_string(once.error());
  EXPECT_THAT(once->svg, HasSubstr("url(#drawing-g)"));
  const auto again = read_drawing("a.svg", once->svg);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->svg, once->svg);
}

}  // namespace
}  // namespace stepwright::drawing
