#include "runtime/modbus/pdu/answer.h"

#include <cstring>

#include "runtime/modbus/pdu/wire.h"

namespace stepwright::modbus::pdu {
namespace {

constexpr std::size_t kTableHeader = 2;  // function, byte count

std::size_t answer_copy(Function function, std::span<const std::byte> data, std::span<std::byte> out) {
  if (!data.empty()) std::memcpy(table_data(out, data.size()).data(), data.data(), data.size());
  return answer_table(function, data.size(), out);
}

}  // namespace

std::size_t table_bytes(const Request& request) {
  return request.reads_bits() ? (request.count + 7u) / 8u : request.count * 2u;
}

std::span<std::byte> table_data(std::span<std::byte> out, std::size_t bytes) {
  return out.subspan(kTableHeader, bytes);
}

std::size_t answer_table(Function function, std::size_t bytes, std::span<std::byte> out) {
  out[0] = static_cast<std::byte>(function);
  out[1] = static_cast<std::byte>(bytes);
  return kTableHeader + bytes;
}

std::size_t answer_bits(Function function, std::span<const std::byte> packed, std::span<std::byte> out) {
  return answer_copy(function, packed, out);
}

std::size_t answer_registers(Function function, std::span<const std::byte> words, std::span<std::byte> out) {
  return answer_copy(function, words, out);
}

std::size_t answer_write(const Request& request, std::span<std::byte> out) {
  out[0] = static_cast<std::byte>(request.function);
  put16(out, 1, request.address);
  switch (request.function) {
    case Function::WriteSingleCoil:
      put16(out, 3, request.data[0] == std::byte{0} ? 0 : 0xFF00);
      return 5;
    case Function::WriteSingleRegister:
      put16(out, 3, get16(request.data, 0));
      return 5;
    case Function::MaskWriteRegister:
      put16(out, 3, request.and_mask);
      put16(out, 5, request.or_mask);
      return 7;
    default:
      put16(out, 3, request.count);
      return 5;
  }
}

std::size_t answer_exception(std::uint8_t function, Exception exception, std::span<std::byte> out) {
  out[0] = static_cast<std::byte>(function | 0x80);
  out[1] = static_cast<std::byte>(exception);
  return 2;
}

}  // namespace stepwright::modbus::pdu
