#include "plant_models/components/unit.h"

#include <gtest/gtest.h>

namespace stepwright::components {
namespace {

TEST(Unit, WhenFiguresHaveUnits_ThenTheyAreSi) {
  const std::pair<const char*, double> figures[] = {
      {"3 l", 3e-3},           {"6000 m/(m3/s)", 6000.0}, {"55 percent", 0.55}, {"20 degC", 293.15},
      {"2 bar", 2e5},          {"90 l/min", 1.5e-3},      {"1 kg/l", 1000.0},   {"0.25 s", 0.25},
      {"4186 J/(kg K)", 4186}, {"10 N/(m/s)", 10.0},      {"12", 12.0},         {"3 m3/h", 3.0 / 3600.0}};
  for (const auto& [text, si] : figures) {
    const auto quantity = parse_quantity(text);
    ASSERT_TRUE(quantity) << text;
    EXPECT_NEAR(quantity->value, si, 1e-12 * si) << text;
  }
  EXPECT_EQ(parse_quantity("3 l")->value, 3.0 * 1e-3);  // to the last bit
}

TEST(Unit, WhenDimensionsAreTheSame_ThenUnitsStandForEachOther) {
  EXPECT_EQ(parse_unit("l/min")->dimension, parse_unit("m3/s")->dimension);
  EXPECT_EQ(parse_unit("bar")->dimension, parse_unit("N/m2")->dimension);
  EXPECT_TRUE(parse_unit("percent")->dimension.none());
  EXPECT_TRUE(parse_unit("rad")->dimension.none());
  EXPECT_NE(parse_unit("kW")->dimension, parse_unit("kJ")->dimension);
  EXPECT_EQ(to_string(parse_unit("l/s")->dimension), "m3 s-1");
}

TEST(Unit, WhenItIsNoFigure_ThenNothing) {
  for (const char* text : {"", "l", "3 litters", "nan l", "1e999 l", "3 mol"})
    EXPECT_FALSE(parse_quantity(text)) << text;
}

TEST(Unit, WhenAUnitIsCalledOtherwise_ThenItsNameIsSaidAndKnown) {
  EXPECT_FALSE(parse_quantity("12 gpm"));
  EXPECT_EQ(unit_hint("12 gpm"), "gpm is \"gallon/min\"");
  EXPECT_EQ(unit_hint("264 gal"), "gal is an acceleration, 1 cm/s2; meant is \"gallon\"");
  EXPECT_EQ(unit_hint("3 furlongz"), "");
  EXPECT_EQ(unit_hint(""), "");
  for (const char* const known :
       {"gallon/min", "gallon/hour", "gallon", "l/min", "ft3/min", "bar", "psi", "cm3"})
    EXPECT_TRUE(parse_unit(known)) << known;
}

}  // namespace
}  // namespace stepwright::components
