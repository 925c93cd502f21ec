#include "runtime/modbus/pdu/identification.h"

#include <cstring>

#include "runtime/modbus/pdu/answer.h"

namespace stepwright::modbus::pdu {
namespace {

constexpr std::byte kMei{0x0E};
constexpr std::byte kRegularBothAccesses{0x82};
constexpr std::uint8_t kLastBasic = 2;
constexpr std::uint8_t kLastRegular = 6;
constexpr std::uint8_t kIndividual = 4;
constexpr std::size_t kHeader = 7;

bool exists(const Identity& device, std::uint8_t object) {
  return object <= kLastRegular && !device.identification(object).empty();
}

// Appends an object; false if there is no room.
bool append(std::uint8_t object, std::span<const std::byte> text, std::span<std::byte> out, std::size_t& at) {
  if (at + 2 + text.size() > kMaxPdu) return false;
  out[at] = static_cast<std::byte>(object);
  out[at + 1] = static_cast<std::byte>(text.size());
  if (!text.empty()) std::memcpy(&out[at + 2], text.data(), text.size());
  at += 2 + text.size();
  return true;
}

void header(std::uint8_t code, std::span<std::byte> out) {
  out[0] = static_cast<std::byte>(Function::EncapsulatedInterface);
  out[1] = kMei;
  out[2] = static_cast<std::byte>(code);
  out[3] = kRegularBothAccesses;
  out[4] = std::byte{0};  // nothing follows
  out[5] = std::byte{0};  // next object
}

}  // namespace

std::size_t answer_identification(const Request& request, const Identity& device, std::span<std::byte> out) {
  const auto function = static_cast<std::uint8_t>(request.function);
  std::size_t at = kHeader;
  header(request.identification_code, out);
  if (request.identification_code == kIndividual) {
    if (!exists(device, request.object))
      return answer_exception(function, Exception::IllegalDataAddress, out);
    if (!append(request.object, device.identification(request.object), out, at))
      return answer_exception(function, Exception::DeviceFailure, out);
    out[6] = std::byte{1};
    return at;
  }
  const std::uint8_t last = request.identification_code == 1 ? kLastBasic : kLastRegular;
  std::uint8_t objects = 0;
  const std::uint8_t first = request.object <= last && exists(device, request.object) ? request.object : 0;
  for (std::uint8_t object = first; object <= last; ++object) {
    if (!exists(device, object)) continue;
    if (!append(object, device.identification(object), out, at)) {
      out[4] = std::byte{0xFF};
      out[5] = static_cast<std::byte>(object);
      break;
    }
    ++objects;
  }
  out[6] = static_cast<std::byte>(objects);
  return at;
}

}  // namespace stepwright::modbus::pdu
