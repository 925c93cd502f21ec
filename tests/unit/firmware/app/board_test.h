#pragma once

#include <gtest/gtest.h>

#include "tests/support/board/board_line.h"
#include "tests/support/remote_controller/remote_controller.h"
#include "tests/unit/firmware/app/programs.h"

namespace stepwright::test {

namespace control = modbus::control;
using control::Command;
using control::Refusal;
using control::State;
using support::BoardLine;
using support::Bytes;
using support::bytes_of;
using support::TestBoard;

// A board with the firmware, and a master at its line.
class BoardTest : public testing::Test {
 protected:
  void load_and_start(const char* program, unsigned flags) {
    controller.download(compiled(program));
    controller.start(flags);
  }
  remote::CommandAnswer bits(Command code, std::uint32_t byte, std::uint64_t mask, std::uint64_t value,
                             std::uint64_t ms = 0) {
    return bits_of(controller.status().digest, code, byte, mask, value, ms);
  }
  remote::CommandAnswer bits_of(const remote::ProgramDigest& program, Command code, std::uint32_t byte,
                                std::uint64_t mask, std::uint64_t value, std::uint64_t ms = 0) {
    std::vector<std::uint16_t> arguments(control::bits::kCount);
    control::put32(arguments, control::bits::kByte, byte);
    control::put64(arguments, control::bits::kMask, mask);
    control::put64(arguments, control::bits::kValue, value);
    control::put_bytes(std::span(arguments).subspan(control::bits::kDigest),
                       std::span(program).first(control::bits::kDigestBytes));
    control::put64(arguments, control::bits::kMs, ms);
    return controller.command(code, arguments);
  }
  // The exception of a request; 0 if it is answered.
  int exception_of(const Bytes& pdu) {
    const Bytes answer = line.ask(pdu);
    if (answer.empty()) return -1;
    return (std::to_integer<int>(answer[0]) & 0x80) != 0 ? std::to_integer<int>(answer.at(1)) : 0;
  }

  TestBoard board;
  BoardLine line{board};
  support::RemoteController controller{line};
};

}  // namespace stepwright::test
