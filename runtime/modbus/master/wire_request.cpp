#include "runtime/modbus/master/wire_request.h"

#include <algorithm>

namespace stepwright::modbus::master {
namespace {

constexpr std::byte kExceptionBit{0x80};
constexpr std::size_t kWriteAnswer = 5;  // function, address, and value or count

}  // namespace

void WireRequest::add16(std::size_t value) {
  add8(value >> 8);
  add8(value & 0xFF);
}

WireRequest WireRequest::read(pdu::Function function, std::uint16_t first, std::size_t count) {
  WireRequest request(function);
  request.add16(first);
  request.add16(count);
  const bool bits = function == pdu::Function::ReadCoils || function == pdu::Function::ReadDiscreteInputs;
  request.answer_bytes_ = 2 + (bits ? bytes_of_bits(count) : 2 * count);
  return request;
}

WireRequest WireRequest::write_single(pdu::Function function, std::uint16_t at, std::uint16_t value) {
  WireRequest request(function);
  request.add16(at);
  request.add16(value);
  request.answer_bytes_ = request.repeated_ = kWriteAnswer;
  return request;
}

WireRequest WireRequest::write_coils(std::uint16_t first, std::span<const std::uint8_t> bits) {
  WireRequest request(pdu::Function::WriteMultipleCoils);
  request.add16(first);
  request.add16(bits.size());
  request.add8(bytes_of_bits(bits.size()));
  for (std::size_t i = 0; i < bits.size(); i += 8) {
    unsigned packed = 0;
    for (std::size_t k = 0; k < 8 && i + k < bits.size(); ++k) packed |= (bits[i + k] != 0 ? 1u : 0u) << k;
    request.add8(packed);
  }
  request.answer_bytes_ = request.repeated_ = kWriteAnswer;
  return request;
}

WireRequest WireRequest::write_registers(std::uint16_t first, std::span<const std::uint16_t> words) {
  WireRequest request(pdu::Function::WriteMultipleRegisters);
  request.add16(first);
  request.add16(words.size());
  request.add8(2 * words.size());
  for (const std::uint16_t word : words) request.add16(word);
  request.answer_bytes_ = request.repeated_ = kWriteAnswer;
  return request;
}

WireRequest WireRequest::mask(std::uint16_t at, std::uint16_t and_mask, std::uint16_t or_mask) {
  WireRequest request(pdu::Function::MaskWriteRegister);
  request.add16(at);
  request.add16(and_mask);
  request.add16(or_mask);
  request.answer_bytes_ = request.repeated_ = request.size_;
  return request;
}

WireRequest WireRequest::read_write(std::uint16_t write_first, std::span<const std::uint16_t> write,
                                    std::uint16_t read_first, std::size_t count) {
  WireRequest request(pdu::Function::ReadWriteMultipleRegisters);
  request.add16(read_first);
  request.add16(count);
  request.add16(write_first);
  request.add16(write.size());
  request.add8(2 * write.size());
  for (const std::uint16_t word : write) request.add16(word);
  request.answer_bytes_ = 2 + 2 * count;
  return request;
}

std::optional<std::uint8_t> WireRequest::exception(Bytes answer) const {
  if (answer.size() != 2 || answer[0] != (bytes_[0] | kExceptionBit)) return std::nullopt;
  return std::to_integer<std::uint8_t>(answer[1]);
}

bool WireRequest::fits(Bytes answer) const {
  if (answer.size() != answer_bytes_ || answer[0] != bytes_[0]) return false;
  if (repeated_ > 0) return std::ranges::equal(answer.first(repeated_), pdu().first(repeated_));
  return std::to_integer<std::size_t>(answer[1]) == answer_bytes_ - 2;
}

}  // namespace stepwright::modbus::master
