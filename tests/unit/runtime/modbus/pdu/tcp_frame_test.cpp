// Frames out of a stream of bytes.

#include "runtime/modbus/pdu/tcp_frame.h"

#include <gtest/gtest.h>

#include "tests/unit/runtime/modbus/pdu/table_model.h"

namespace stepwright::modbus::pdu {
namespace {

using State = TcpTake::State;

TEST(TcpFrame, WhenWhole_ThenItsParts) {
  const Bytes stream = bytes({0x12, 0x34, 0, 0, 0, 6, 17, 3, 0, 1, 0, 2, 0x55});
  const TcpTake take = take_frame(stream);
  ASSERT_EQ(take.state, State::Frame);
  EXPECT_EQ(take.frame.transaction, 0x1234);
  EXPECT_EQ(take.frame.unit, 17);
  EXPECT_EQ(hex(take.frame.pdu), "03 00 01 00 02");
  EXPECT_EQ(take.frame.bytes, 12u);
}

TEST(TcpFrame, WhenCutAnywhere_ThenNeedsMore) {
  const Bytes stream = bytes({0x12, 0x34, 0, 0, 0, 6, 17, 3, 0, 1, 0, 2});
  for (std::size_t size = 0; size < stream.size(); ++size)
    EXPECT_EQ(take_frame(std::span(stream).first(size)).state, State::NeedsMore) << size;
}

TEST(TcpFrame, WhenProtocolOrLengthCannotBe_ThenBadAtOnce) {
  EXPECT_EQ(take_frame(bytes({0, 1, 0, 1})).state, State::Bad);
  EXPECT_EQ(take_frame(bytes({0, 1, 1, 0})).state, State::Bad);
  for (const unsigned length : {0u, 1u, 267u, 0x200u, 0xFFFFu})
    EXPECT_EQ(take_frame(bytes({0, 1, 0, 0, length >> 8, length & 0xFF})).state, State::Bad) << length;
  EXPECT_EQ(take_frame(bytes({0, 1, 0, 0, 1, 10})).state, State::NeedsMore);
  EXPECT_EQ(take_frame(bytes({0, 1, 0, 0, 0, 2, 1, 7})).state, State::Frame);
}

TEST(TcpFrame, WhenTheLongest_ThenItFits) {
  Bytes stream = bytes({0, 1, 0, 0, 0, 254, 1});
  stream.resize(kMaxTcpFrame);
  const TcpTake take = take_frame(stream);
  ASSERT_EQ(take.state, State::Frame);
  EXPECT_EQ(take.frame.pdu.size(), kMaxPdu);
}

TEST(TcpFrame, WhenAnAnswerIsSealed_ThenItIsAFrame) {
  Bytes frame(kMaxTcpFrame);
  tcp_pdu(frame)[0] = std::byte{0x83};
  tcp_pdu(frame)[1] = std::byte{2};
  const std::size_t size = seal_tcp(frame, 0xABCD, 9, 2);
  EXPECT_EQ(hex(std::span(frame).first(size)), "ab cd 00 00 00 03 09 83 02");
}

}  // namespace
}  // namespace stepwright::modbus::pdu
