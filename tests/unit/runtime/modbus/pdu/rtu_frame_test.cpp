// Frames out of a serial line on which there is noise, and other slaves.

#include "runtime/modbus/pdu/rtu_frame.h"

#include <gtest/gtest.h>

#include "runtime/modbus/pdu/crc16.h"
#include "tests/unit/runtime/modbus/pdu/table_model.h"

namespace stepwright::modbus::pdu {
namespace {

Bytes framed(const Bytes& covered) {
  Bytes frame = covered;
  const std::uint16_t crc = crc16(covered);
  frame.push_back(static_cast<std::byte>(crc & 0xFF));
  frame.push_back(static_cast<std::byte>(crc >> 8));
  return frame;
}

Bytes operator+(Bytes left, const Bytes& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

class Rtu : public testing::Test {
 protected:
  std::vector<std::string> taken(const Bytes& line) {
    std::vector<std::string> frames;
    for (const std::byte byte : line) {
      receiver_.push(byte);
      while (const RtuFrame frame = receiver_.take())
        frames.push_back((frame.broadcast() ? "all: " : "") + hex(frame.pdu));
    }
    return frames;
  }
  using Frames = std::vector<std::string>;

  RtuReceiver receiver_{17};
  const Bytes read_ = framed(bytes({17, 3, 0, 1, 0, 2}));
};

TEST_F(Rtu, WhenCrc_ThenThatOfTheStandard) {
  // Modbus over Serial Line V1.02, 6.2.2: 02 07 gives 41 12
  EXPECT_EQ(hex(framed(bytes({2, 7}))), "02 07 41 12");
  EXPECT_EQ(crc16(framed(bytes({1, 2, 3}))), 0);
}

TEST_F(Rtu, WhenFramesFollowEachOther_ThenEachAtItsLastByte) {
  const Bytes write = framed(bytes({17, 16, 0, 1, 0, 2, 4, 0, 10, 1, 2}));
  const Bytes coils = framed(bytes({17, 15, 0, 1, 0, 2, 1, 3}));
  const Bytes both = framed(bytes({17, 23, 0, 3, 0, 6, 0, 14, 0, 1, 2, 0, 0xFF}));
  const Bytes mask = framed(bytes({17, 22, 0, 4, 0, 0xF2, 0, 0x25}));
  const Bytes who = framed(bytes({17, 43, 14, 1, 0}));
  EXPECT_EQ(taken(read_ + write + coils + both + mask + who),
            (Frames{"03 00 01 00 02", "10 00 01 00 02 04 00 0a 01 02", "0f 00 01 00 02 01 03",
                    "17 00 03 00 06 00 0e 00 01 02 00 ff", "16 00 04 00 f2 00 25", "2b 0e 01 00"}));
  EXPECT_EQ(receiver_.garbage_bytes(), 0u);
}

TEST_F(Rtu, WhenGarbageComesFirst_ThenTheFrameIsFound) {
  for (unsigned first = 0; first < 256; ++first) {
    receiver_ = RtuReceiver(17);
    const Bytes noise = bytes({first});
    const Frames frames =
        taken(noise + read_ + read_ + read_ + read_ + read_ + read_ + read_ + read_ + read_);
    ASSERT_FALSE(frames.empty()) << first;
    EXPECT_EQ(frames.back(), "03 00 01 00 02") << first;
  }
}

TEST_F(Rtu, WhenTheCrcIsWrong_ThenThatFrameOnlyIsLost) {
  Bytes broken = read_;
  broken[4] ^= std::byte{1};
  EXPECT_EQ(taken(broken + read_), (Frames{"03 00 01 00 02"}));
  EXPECT_EQ(receiver_.garbage_bytes(), 8u);
}

TEST_F(Rtu, WhenOthersSpeak_ThenTheyArePassedOver) {
  const Bytes asked = framed(bytes({5, 3, 0, 1, 0, 2}));
  const Bytes told = framed(bytes({5, 3, 4, 17, 3, 17, 3}));
  const Bytes refused = framed(bytes({5, 0x83, 2}));
  const Bytes wrote = framed(bytes({5, 16, 0, 1, 0, 2}));
  EXPECT_EQ(taken(asked + told + asked + refused + wrote + read_), (Frames{"03 00 01 00 02"}));
  EXPECT_EQ(receiver_.garbage_bytes(), 0u);
}

TEST_F(Rtu, WhenBroadcast_ThenItIsGivenOutButNotAnswered) {
  const Bytes write = framed(bytes({0, 6, 0, 1, 0, 3}));
  EXPECT_EQ(taken(write), (Frames{"all: 06 00 01 00 03"}));
  TableModel model;
  Bytes out(kMaxRtuFrame);
  RtuReceiver receiver(17);
  for (const std::byte byte : write) receiver.push(byte);
  EXPECT_EQ(serve_rtu(model, receiver.take(), out), 0u);
  EXPECT_EQ(model.holding[1], 3);
  for (const std::byte byte : framed(bytes({0, 3, 0, 1, 0, 3}))) receiver.push(byte);
  EXPECT_EQ(serve_rtu(model, receiver.take(), out), 0u);
}

TEST_F(Rtu, WhenTheFunctionIsUnknown_ThenItsFrameEndsWithItsCrc) {
  EXPECT_EQ(taken(framed(bytes({17, 7})) + framed(bytes({17, 0x41, 1, 2, 3})) + read_),
            (Frames{"07", "41 01 02 03", "03 00 01 00 02"}));
  Bytes file = bytes({17, 20, 245});
  file.resize(3 + 245, std::byte{6});
  EXPECT_EQ(taken(framed(file) + read_).size(), 2u);
}

TEST_F(Rtu, WhenSilence_ThenWhatHasBegunIsForgotten) {
  EXPECT_EQ(taken(bytes({17, 16, 0, 1, 0, 100, 200, 1, 2, 3})), Frames{});
  receiver_.silence();
  EXPECT_EQ(taken(read_), (Frames{"03 00 01 00 02"}));
  EXPECT_EQ(receiver_.garbage_bytes(), 10u);
}

TEST_F(Rtu, WhenNothingButNoise_ThenItStaysWithinItsBuffer) {
  std::uint32_t state = 1;
  for (int i = 0; i < 200'000; ++i) {
    state = state * 1664525u + 1013904223u;
    // every third byte is the slave's own address, so that much looks like a beginning
    receiver_.push(i % 3 == 0 ? std::byte{17} : static_cast<std::byte>(state >> 24));
    while (receiver_.take()) {
    }
  }
  receiver_.silence();
  EXPECT_EQ(taken(read_), (Frames{"03 00 01 00 02"}));
}

TEST_F(Rtu, WhenServed_ThenTheAnswerIsAFrame) {
  TableModel model;
  model.holding[1] = 0xABCD;
  for (const std::byte byte : framed(bytes({17, 3, 0, 1, 0, 1}))) receiver_.push(byte);
  Bytes out(kMaxRtuFrame);
  const std::size_t size = serve_rtu(model, receiver_.take(), out);
  EXPECT_EQ(hex(std::span(out).first(size)), hex(framed(bytes({17, 3, 2, 0xAB, 0xCD}))));
}

}  // namespace
}  // namespace stepwright::modbus::pdu
