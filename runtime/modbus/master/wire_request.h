#pragma once

// A request as it goes over the wire, and what an answer has to be to be one to it (Modbus Application
// Protocol V1.1b3, section 6): its function, every length in it, and of a write what it repeats.
//
//   const WireRequest request = WireRequest::read(3, first, count);
//   ... send request.pdu(), receive an answer ...
//   if (request.fits(answer)) copy(request.table(answer));
//
// A value without heap; any thread. Addresses and counts are the caller's to check.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "runtime/modbus/pdu/request.h"

namespace stepwright::modbus::master {

constexpr std::size_t bytes_of_bits(std::size_t bits) {
  return (bits + 7) / 8;
}

class WireRequest {
 public:
  using Bytes = std::span<const std::byte>;

  static WireRequest read(pdu::Function function, std::uint16_t first, std::size_t count);  // FC 1 to 4
  static WireRequest write_single(pdu::Function function, std::uint16_t at, std::uint16_t value);  // FC 5, 6
  static WireRequest write_coils(std::uint16_t first, std::span<const std::uint8_t> bits);         // FC 15
  static WireRequest write_registers(std::uint16_t first, std::span<const std::uint16_t> words);   // FC 16
  static WireRequest mask(std::uint16_t at, std::uint16_t and_mask, std::uint16_t or_mask);        // FC 22
  static WireRequest read_write(std::uint16_t write_first, std::span<const std::uint16_t> write,
                                std::uint16_t read_first, std::size_t count);  // FC 23

  Bytes pdu() const { return std::span(bytes_).first(size_); }
  // How long the PDU of the answer is if the slave does what was asked.
  std::size_t answer_bytes() const { return answer_bytes_; }
  // The exception that the slave answers with; none if it is no such answer to this request.
  std::optional<std::uint8_t> exception(Bytes answer) const;
  // Whether the slave has done what was asked.
  bool fits(Bytes answer) const;
  // The bits or registers of an answer that fits.
  Bytes table(Bytes answer) const { return answer.subspan(2); }

 private:
  explicit WireRequest(pdu::Function function) { add8(static_cast<std::uint8_t>(function)); }
  void add8(std::size_t value) { bytes_[size_++] = static_cast<std::byte>(value); }
  void add16(std::size_t value);

  std::array<std::byte, pdu::kMaxPdu> bytes_{};
  std::size_t size_ = 0;
  std::size_t answer_bytes_ = 0;
  std::size_t repeated_ = 0;  // so many bytes of the request begin the answer, too
};

}  // namespace stepwright::modbus::master
