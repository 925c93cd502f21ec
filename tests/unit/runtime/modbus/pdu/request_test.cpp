// What arrives: lengths, counts and values are judged before anything is carried out.

#include "runtime/modbus/pdu/request.h"

#include <gtest/gtest.h>

#include "tests/unit/runtime/modbus/pdu/table_model.h"

namespace stepwright::modbus::pdu {
namespace {

Exception judged(const Bytes& pdu) {
  return parse(pdu).exception;
}

TEST(Request, WhenARead_ThenAddressAndCount) {
  const Bytes pdu = bytes({3, 0x12, 0x34, 0, 125});
  const Parsed parsed = parse(pdu);
  EXPECT_EQ(parsed.exception, Exception::None);
  EXPECT_EQ(parsed.request.function, Function::ReadHoldingRegisters);
  EXPECT_EQ(parsed.request.address, 0x1234);
  EXPECT_EQ(parsed.request.count, 125);
  EXPECT_FALSE(parsed.request.writes());
}

TEST(Request, WhenTheCountIsZeroOrTooLarge_ThenIllegalValue) {
  for (const unsigned function : {1u, 2u}) {
    EXPECT_EQ(judged(bytes({function, 0, 0, 0, 0})), Exception::IllegalDataValue);
    EXPECT_EQ(judged(bytes({function, 0, 0, 0x07, 0xD0})), Exception::None);
    EXPECT_EQ(judged(bytes({function, 0, 0, 0x07, 0xD1})), Exception::IllegalDataValue);
    EXPECT_EQ(judged(bytes({function, 0, 0, 0xFF, 0xFF})), Exception::IllegalDataValue);
  }
  for (const unsigned function : {3u, 4u}) {
    EXPECT_EQ(judged(bytes({function, 0, 0, 0, 0})), Exception::IllegalDataValue);
    EXPECT_EQ(judged(bytes({function, 0, 0, 0, 125})), Exception::None);
    EXPECT_EQ(judged(bytes({function, 0, 0, 0, 126})), Exception::IllegalDataValue);
  }
}

TEST(Request, WhenTheRangeGoesBeyond65535_ThenIllegalAddress) {
  EXPECT_EQ(judged(bytes({3, 0xFF, 0xFF, 0, 1})), Exception::None);
  EXPECT_EQ(judged(bytes({3, 0xFF, 0xFF, 0, 2})), Exception::IllegalDataAddress);
  EXPECT_EQ(judged(bytes({15, 0xFF, 0xFF, 0, 2, 1, 3})), Exception::IllegalDataAddress);
  EXPECT_EQ(judged(bytes({16, 0xFF, 0xFF, 0, 2, 4, 0, 1, 0, 2})), Exception::IllegalDataAddress);
  EXPECT_EQ(judged(bytes({23, 0, 0, 0, 1, 0xFF, 0xFF, 0, 2, 4, 0, 1, 0, 2})), Exception::IllegalDataAddress);
}

TEST(Request, WhenACoilIsNeitherOnNorOff_ThenIllegalValue) {
  EXPECT_EQ(judged(bytes({5, 0, 1, 0xFF, 0})), Exception::None);
  EXPECT_EQ(judged(bytes({5, 0, 1, 0, 0})), Exception::None);
  EXPECT_EQ(judged(bytes({5, 0, 1, 0, 1})), Exception::IllegalDataValue);
  EXPECT_EQ(judged(bytes({5, 0, 1, 0xFF, 1})), Exception::IllegalDataValue);
  EXPECT_EQ(parse(bytes({5, 0, 1, 0xFF, 0})).request.data[0], std::byte{1});
  EXPECT_EQ(parse(bytes({5, 0, 1, 0, 0})).request.data[0], std::byte{0});
}

TEST(Request, WhenTheByteCountDoesNotFit_ThenIllegalValue) {
  EXPECT_EQ(judged(bytes({15, 0, 0, 0, 9, 2, 0xFF, 1})), Exception::None);
  EXPECT_EQ(judged(bytes({15, 0, 0, 0, 9, 1, 0xFF, 1})), Exception::IllegalDataValue);
  EXPECT_EQ(judged(bytes({15, 0, 0, 0, 9, 2, 0xFF})), Exception::IllegalDataValue);
  EXPECT_EQ(judged(bytes({16, 0, 0, 0, 1, 2, 0, 7})), Exception::None);
  EXPECT_EQ(judged(bytes({16, 0, 0, 0, 2, 2, 0, 7})), Exception::IllegalDataValue);
  EXPECT_EQ(judged(bytes({16, 0, 0, 0, 1, 2, 0, 7, 0})), Exception::IllegalDataValue);
  EXPECT_EQ(judged(bytes({23, 0, 0, 0, 1, 0, 0, 0, 1, 4, 0, 7, 0, 8})), Exception::IllegalDataValue);
}

TEST(Request, WhenTruncatedAnywhere_ThenIllegalValueAndNothingElse) {
  const std::vector<Bytes> whole = {bytes({1, 0, 0, 0, 1}),
                                    bytes({5, 0, 0, 0xFF, 0}),
                                    bytes({6, 0, 0, 1, 2}),
                                    bytes({15, 0, 0, 0, 3, 1, 5}),
                                    bytes({16, 0, 0, 0, 2, 4, 1, 2, 3, 4}),
                                    bytes({22, 0, 4, 0, 0xF2, 0, 0x25}),
                                    bytes({23, 0, 3, 0, 6, 0, 14, 0, 1, 2, 0, 0xFF}),
                                    bytes({43, 14, 1, 0})};
  for (const Bytes& pdu : whole) {
    ASSERT_EQ(judged(pdu), Exception::None) << hex(pdu);
    for (std::size_t size = 1; size < pdu.size(); ++size)
      EXPECT_EQ(judged(Bytes(pdu.begin(), pdu.begin() + static_cast<std::ptrdiff_t>(size))),
                Exception::IllegalDataValue)
          << hex(pdu) << " cut to " << size;
  }
}

TEST(Request, WhenTheFunctionIsNotServed_ThenIllegalFunction) {
  for (unsigned function = 0; function < 256; ++function) {
    const bool served = (function >= 1 && function <= 6) || function == 15 || function == 16 ||
                        function == 22 || function == 23 || function == 43;
    const Parsed parsed = parse(bytes({function, 0, 0, 0, 1}));
    EXPECT_EQ(parsed.function, function);
    EXPECT_EQ(parsed.exception == Exception::IllegalFunction, !served || function == 43) << function;
  }
}

TEST(Request, WhenBothHalvesOfFunction23_ThenBothAreThere) {
  const Bytes pdu = bytes({23, 0, 3, 0, 6, 0, 14, 0, 1, 2, 0xAB, 0xCD});
  const Request request = parse(pdu).request;
  EXPECT_EQ(request.address, 3);
  EXPECT_EQ(request.count, 6);
  EXPECT_EQ(request.write_address, 14);
  EXPECT_EQ(request.write_count, 1);
  EXPECT_EQ(hex(request.data), "ab cd");
  EXPECT_TRUE(request.writes());
}

}  // namespace
}  // namespace stepwright::modbus::pdu
