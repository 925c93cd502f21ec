#include "plant_models/bridge/io_address.h"

#include <gtest/gtest.h>

namespace stepwright::bridge {
namespace {

TEST(IoAddress, WhenWellFormed_ThenAreaWidthAndPlaceAreRead) {
  const auto read = [](const char* text) { return parse_io_address(text, {}).value(); };
  EXPECT_EQ(read("%IX0.0"), (IoAddress{IoArea::Input, IoWidth::Bit, 0, 0}));
  EXPECT_EQ(read("%QX12.7"), (IoAddress{IoArea::Output, IoWidth::Bit, 12, 7}));
  EXPECT_EQ(read("%q3.1"), (IoAddress{IoArea::Output, IoWidth::Bit, 3, 1}));
  EXPECT_EQ(read("%IB5"), (IoAddress{IoArea::Input, IoWidth::Byte, 5, 0}));
  EXPECT_EQ(read("%IW1"), (IoAddress{IoArea::Input, IoWidth::Word, 2, 0}));
  EXPECT_EQ(read("%QD2"), (IoAddress{IoArea::Output, IoWidth::DoubleWord, 8, 0}));
}

TEST(IoAddress, WhenMalformed_ThenRefusedAtItsPlace) {
  for (const char* text : {"", "%", "IX0.0", "%I", "%IX", "%IX0.", "%IX0.8", "%IX-1.0", "%IX0.0 ", "%MW1",
                           "%IW", "%IW1.0", "%IX0.0.0", "%IW4294967296", "%IW2000000", "%IX 0.0", "%II0.0"}) {
    const auto address = parse_io_address(text, {"cell.toml", 7, 3});
    ASSERT_FALSE(address) << text;
    EXPECT_EQ(address.error().front().code, "C0302");
    EXPECT_EQ(address.error().front().where.line, 7u);
  }
}

TEST(IoAddress, WhenWritten_ThenReadsBack) {
  for (const char* text : {"%IX0.0", "%QX12.7", "%IB5", "%IW3", "%QD2"}) {
    EXPECT_EQ(to_string(parse_io_address(text, {}).value()), text);
  }
  EXPECT_EQ(to_string(parse_io_address("%QX75", {}).value()), "%QX9.3");  // the bits of the area, counted
}

}  // namespace
}  // namespace stepwright::bridge
