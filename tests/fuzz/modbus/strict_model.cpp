#include "tests/fuzz/modbus/strict_model.h"

#include <array>
#include <cstdlib>
#include <string_view>

#include "runtime/modbus/pdu/request.h"

namespace stepwright::fuzz::modbus {

namespace {

namespace pdu = stepwright::modbus::pdu;
using pdu::Exception;

// Addresses from here on do not exist, so that exceptions of the model have their turn.
constexpr std::uint16_t kEnd = 0x2000;

void demand(bool condition) {
  if (!condition) std::abort();
}

void demand_range(std::uint16_t address, std::uint16_t count, std::uint16_t most) {
  demand(count >= 1 && count <= most && std::uint32_t{address} + count <= 65536);
}

void fill(std::span<std::byte> out) {
  for (std::byte& each : out) each = std::byte{0x55};
}

unsigned sum_of(std::span<const std::byte> bytes) {
  unsigned sum = 0;
  for (const std::byte each : bytes) sum += std::to_integer<unsigned>(each);
  return sum;
}

}  // namespace

Exception StrictModel::answer(std::uint16_t address) {
  ++calls_;
  return address < kEnd ? Exception::None : Exception::IllegalDataAddress;
}

Exception StrictModel::read_bits(pdu::BitTable, std::uint16_t address, std::uint16_t count,
                                 std::span<std::byte> packed) {
  demand_range(address, count, pdu::kMaxReadBits);
  demand(packed.size() == (count + 7u) / 8u);
  fill(packed);
  return answer(address);
}

Exception StrictModel::read_registers(pdu::RegisterTable, std::uint16_t address, std::uint16_t count,
                                      std::span<std::byte> words) {
  demand_range(address, count, pdu::kMaxReadRegisters);
  demand(words.size() == count * 2u);
  fill(words);
  return answer(address);
}

Exception StrictModel::write_coils(std::uint16_t address, std::uint16_t count,
                                   std::span<const std::byte> packed) {
  demand_range(address, count, pdu::kMaxWriteBits);
  demand(packed.size() == (count + 7u) / 8u);
  sum_ += sum_of(packed);
  return answer(address);
}

Exception StrictModel::write_registers(std::uint16_t address, std::uint16_t count,
                                       std::span<const std::byte> words) {
  demand_range(address, count, pdu::kMaxWriteRegisters);
  demand(words.size() == count * 2u);
  sum_ += sum_of(words);
  return answer(address);
}

Exception StrictModel::mask_register(std::uint16_t address, std::uint16_t and_mask, std::uint16_t or_mask) {
  sum_ += pdu::masked(0, and_mask, or_mask);
  return answer(address);
}

Exception StrictModel::read_write_registers(const pdu::ReadWrite& what, std::span<std::byte> words) {
  demand_range(what.read_address, what.read_count, pdu::kMaxReadRegisters);
  demand_range(what.write_address, what.write_count, pdu::kMaxReadWriteRegisters);
  demand(words.size() == what.read_count * 2u && what.words.size() == what.write_count * 2u);
  sum_ += sum_of(what.words);
  fill(words);
  return answer(what.read_address);
}

std::span<const std::byte> StrictModel::identification(std::uint8_t object) const {
  // The longest texts that may be: they do not fit into one answer.
  static constexpr std::array<char, 200> kText{'S', 't', 'e', 'p'};
  return object <= 6 ? std::as_bytes(std::span(kText)) : std::span<const std::byte>{};
}

}  // namespace stepwright::fuzz::modbus
