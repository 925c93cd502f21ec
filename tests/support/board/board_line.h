#pragma once

// The line to a TestBoard: requests as RTU frames of the test's own making, so that the firmware's framing is
// judged by something else; the main loop turns while an answer is awaited.

#include <stdexcept>
#include <string>

#include "runtime/modbus/pdu/crc16.h"
#include "runtime/remote/register_line.h"
#include "tests/support/board/test_board.h"

namespace stepwright::support {

using Bytes = std::vector<std::byte>;

inline Bytes bytes_of(std::initializer_list<int> values) {
  Bytes bytes;
  for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
  return bytes;
}

class BoardLine final : public remote::RegisterLine {
 public:
  explicit BoardLine(TestBoard& board) : board_(board) {}

  // The PDU of the answer; empty if none came.
  Bytes ask(const Bytes& pdu, std::uint8_t unit = 1) {
    Bytes frame{static_cast<std::byte>(unit)};
    frame.insert(frame.end(), pdu.begin(), pdu.end());
    const std::uint16_t crc = modbus::pdu::crc16(frame);
    frame.push_back(static_cast<std::byte>(crc & 0xFF));
    frame.push_back(static_cast<std::byte>(crc >> 8));
    board_.uart.outgoing.clear();
    board_.uart.incoming.insert(board_.uart.incoming.end(), frame.begin(), frame.end());
    for (int i = 0; i < kTurns; ++i) board_.firmware().turn();
    Bytes answer = board_.uart.outgoing;
    if (answer.size() < 4) return {};
    if (modbus::pdu::crc16(answer) != 0) throw std::runtime_error("an answer has a wrong CRC");
    return {answer.begin() + 1, answer.end() - 2};
  }

  remote::LineAnswer read(std::uint16_t first, std::span<std::uint16_t> words) override {
    Bytes pdu = bytes_of({3});
    put(pdu, first);
    put(pdu, words.size());
    return take(ask(pdu), words);
  }
  remote::LineAnswer write(std::uint16_t first, std::span<const std::uint16_t> words) override {
    Bytes pdu = bytes_of({16});
    put(pdu, first);
    put_all(pdu, words);
    return take(ask(pdu), {});
  }
  remote::LineAnswer read_write(std::uint16_t write_first, std::span<const std::uint16_t> write,
                                std::uint16_t read_first, std::span<std::uint16_t> read) override {
    Bytes pdu = bytes_of({23});
    put(pdu, read_first);
    put(pdu, read.size());
    put(pdu, write_first);
    put_all(pdu, write);
    return take(ask(pdu), read);
  }
  remote::LineAnswer reopen() override { return {}; }
  std::string name() const override { return "test board"; }

 private:
  static constexpr int kTurns = 48;  // an answer of 256 bytes in parts of seven, and what follows it

  static void put(Bytes& bytes, std::size_t word) {
    bytes.push_back(static_cast<std::byte>(word >> 8));
    bytes.push_back(static_cast<std::byte>(word));
  }
  static void put_all(Bytes& bytes, std::span<const std::uint16_t> words) {
    put(bytes, words.size());
    bytes.push_back(static_cast<std::byte>(words.size() * 2));
    for (const std::uint16_t word : words) put(bytes, word);
  }
  static remote::LineAnswer take(const Bytes& answer, std::span<std::uint16_t> words) {
    if (answer.empty()) return {remote::LineFault::Silent, 0, {}};
    if ((std::to_integer<unsigned>(answer[0]) & 0x80) != 0)
      return {remote::LineFault::Refused, std::to_integer<std::uint8_t>(answer.at(1)), {}};
    for (std::size_t i = 0; i < words.size(); ++i)
      words[i] = static_cast<std::uint16_t>(std::to_integer<unsigned>(answer.at(2 + 2 * i)) << 8 |
                                            std::to_integer<unsigned>(answer.at(3 + 2 * i)));
    return {};
  }

  TestBoard& board_;
};

}  // namespace stepwright::support
