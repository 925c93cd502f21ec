#include "runtime/ground/naming/direct_address.h"

#include <gtest/gtest.h>

namespace stepwright::naming {
namespace {

TEST(DirectAddress, WhenWellFormed_ThenAreaSizeAndPlaceAreRead) {
  EXPECT_EQ(parse_direct_address("%IX0.0"), (DirectAddress{Area::Input, 1, 0, 0}));
  EXPECT_EQ(parse_direct_address("%QX12.7"), (DirectAddress{Area::Output, 1, 12, 7}));
  EXPECT_EQ(parse_direct_address("%QB5"), (DirectAddress{Area::Output, 8, 5, 0}));
  EXPECT_EQ(parse_direct_address("%IW1"), (DirectAddress{Area::Input, 16, 2, 0}));
  EXPECT_EQ(parse_direct_address("%MD3"), (DirectAddress{Area::Marker, 32, 12, 0}));
  EXPECT_EQ(parse_direct_address("%ML2"), (DirectAddress{Area::Marker, 64, 16, 0}));
}

TEST(DirectAddress, WhenSpeltAnotherWay_ThenItIsTheSameAddress) {
  EXPECT_EQ(parse_direct_address("%qx4.7"), parse_direct_address("%QX4.7"));
  EXPECT_EQ(parse_direct_address("%Q4.7"), parse_direct_address("%QX4.7"));
  EXPECT_EQ(parse_direct_address("%MW1_024"), parse_direct_address("%MW1024"));
}

TEST(DirectAddress, WhenABitHasOneNumber_ThenTheBitsOfTheAreaAreCounted) {
  EXPECT_EQ(parse_direct_address("%IX0"), parse_direct_address("%IX0.0"));
  EXPECT_EQ(parse_direct_address("%QX75"), parse_direct_address("%QX9.3"));
  EXPECT_EQ(parse_direct_address("%Q75"), parse_direct_address("%QX9.3"));
  EXPECT_EQ(parse_direct_address("%MX524287"), parse_direct_address("%MX65535.7"));
  EXPECT_FALSE(parse_direct_address("%MX524288"));
}

TEST(DirectAddress, WhenItIsTheLastOfTheArea_ThenTheNextIsBeyond) {
  EXPECT_TRUE(parse_direct_address("%IX65535.7"));
  EXPECT_FALSE(parse_direct_address("%IX65536.0"));
  EXPECT_TRUE(parse_direct_address("%IW32767"));
  EXPECT_FALSE(parse_direct_address("%IW32768"));
  EXPECT_TRUE(parse_direct_address("%IL8191"));
  EXPECT_FALSE(parse_direct_address("%IL8192"));
  EXPECT_FALSE(parse_direct_address("%IB4294967296"));
}

TEST(DirectAddress, WhenIllFormed_ThenThereIsNone) {
  for (const char* text : {"",        "%",       "%I",       "IX0.0",  "%IX",    "%IX1_",   "%IX0.",
                           "%IX.1",   "%IX0.8",  "%IX0.0.0", "%IXx.1", "%II0.0", "%ZX0.0",  "%X1",
                           "%IW",     "%IW1.",   "%IW1.2",   "%IW-1",  "%IW+1",  "%IW1 ",   "%IX0.0 ",
                           "%IX 0.0", " %IX0.0", "%MW1__0",  "%MW_1",  "%MW1_",  "%IX0.1_", "%IX0x.1"}) {
    EXPECT_FALSE(parse_direct_address(text)) << text;
  }
}

}  // namespace
}  // namespace stepwright::naming
