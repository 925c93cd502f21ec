// Requests and their answers byte for byte; the examples are those of the Modbus Application Protocol V1.1b3.

#include "runtime/modbus/pdu/serve.h"

#include <gtest/gtest.h>

#include "tests/unit/runtime/modbus/pdu/table_model.h"

namespace stepwright::modbus::pdu {
namespace {

class Serve : public testing::Test {
 protected:
  std::string answer(const Bytes& request) {
    std::array<std::byte, kMaxPdu> out;
    out.fill(std::byte{0xEE});
    return hex(std::span(out).first(serve(model_, request, out)));
  }

  TableModel model_;
};

TEST_F(Serve, WhenCoilsAreRead_ThenTheyArePackedFromTheLowestBit) {
  // 6.1: outputs 20 to 38, CD 6B 05
  const unsigned values[] = {0xCD, 0x6B, 0x05};
  for (std::size_t i = 0; i < 19; ++i) model_.coils[0x13 + i] = (values[i / 8] >> i % 8 & 1) != 0;
  EXPECT_EQ(answer(bytes({1, 0, 0x13, 0, 0x13})), "01 03 cd 6b 05");
  model_.discrete[0] = true;
  EXPECT_EQ(answer(bytes({2, 0, 0, 0, 1})), "02 01 01");
}

TEST_F(Serve, WhenRegistersAreRead_ThenTheyAreBigEndian) {
  model_.holding[0x6B] = 0x022B;
  model_.holding[0x6D] = 0x64;
  EXPECT_EQ(answer(bytes({3, 0, 0x6B, 0, 3})), "03 06 02 2b 00 00 00 64");
  model_.input[8] = 10;
  EXPECT_EQ(answer(bytes({4, 0, 8, 0, 1})), "04 02 00 0a");
}

TEST_F(Serve, WhenSingleWrites_ThenTheRequestIsRepeated) {
  EXPECT_EQ(answer(bytes({5, 0, 0xAC, 0xFF, 0})), "05 00 ac ff 00");
  EXPECT_TRUE(model_.coils[0xAC]);
  EXPECT_EQ(answer(bytes({5, 0, 0xAC, 0, 0})), "05 00 ac 00 00");
  EXPECT_FALSE(model_.coils[0xAC]);
  EXPECT_EQ(answer(bytes({6, 0, 1, 0, 3})), "06 00 01 00 03");
  EXPECT_EQ(model_.holding[1], 3);
}

TEST_F(Serve, WhenMultipleWrites_ThenAddressAndCount) {
  EXPECT_EQ(answer(bytes({15, 0, 0x13, 0, 10, 2, 0xCD, 1})), "0f 00 13 00 0a");
  EXPECT_TRUE(model_.coils[0x13]);
  EXPECT_FALSE(model_.coils[0x14]);
  EXPECT_TRUE(model_.coils[0x1B]);
  EXPECT_EQ(answer(bytes({16, 0, 1, 0, 2, 4, 0, 10, 1, 2})), "10 00 01 00 02");
  EXPECT_EQ(model_.holding[1], 10);
  EXPECT_EQ(model_.holding[2], 0x102);
}

TEST_F(Serve, WhenMaskWrite_ThenAsTheStandardsExample) {
  model_.holding[4] = 0x12;
  EXPECT_EQ(answer(bytes({22, 0, 4, 0, 0xF2, 0, 0x25})), "16 00 04 00 f2 00 25");
  EXPECT_EQ(model_.holding[4], 0x17);
}

TEST_F(Serve, WhenReadWrite_ThenTheWriteComesFirst) {
  EXPECT_EQ(answer(bytes({23, 0, 3, 0, 2, 0, 4, 0, 1, 2, 0xAB, 0xCD})), "17 04 00 00 ab cd");
}

TEST_F(Serve, WhenReadWriteReadsBeyondTheTable_ThenNothingIsWritten) {
  EXPECT_EQ(answer(bytes({23, 0x01, 0x2C, 0, 1, 0, 4, 0, 1, 2, 0xAB, 0xCD})), "97 02");
  EXPECT_EQ(model_.holding[4], 0);
}

TEST_F(Serve, WhenBeyondTheTable_ThenException2) {
  EXPECT_EQ(answer(bytes({3, 0x01, 0x2B, 0, 1})), "03 02 00 00");  // 299, the last one
  EXPECT_EQ(answer(bytes({3, 0x01, 0x2B, 0, 2})), "83 02");
  EXPECT_EQ(answer(bytes({15, 0x01, 0x2B, 0, 2, 1, 3})), "8f 02");
}

TEST_F(Serve, WhenMalformed_ThenExceptionAndNoWrite) {
  EXPECT_EQ(answer(bytes({16, 0, 1, 0, 2, 2, 0, 10})), "90 03");
  EXPECT_EQ(answer(bytes({5, 0, 1, 0x12, 0x34})), "85 03");
  EXPECT_EQ(answer(bytes({7})), "87 01");
  EXPECT_EQ(answer(bytes({0x83, 2})), "83 01");
  EXPECT_EQ(answer({}), "");
  EXPECT_EQ(model_.writes, 0);
}

TEST_F(Serve, WhenTheLongestReads_ThenTheyFitAPdu) {
  std::array<std::byte, kMaxPdu> out;
  EXPECT_EQ(serve(model_, bytes({3, 0, 0, 0, 125}), out), 252u);
  EXPECT_EQ(serve(model_, bytes({1, 0, 0, 1, 0x2C}), out), 2u + 38u);
}

}  // namespace
}  // namespace stepwright::modbus::pdu
