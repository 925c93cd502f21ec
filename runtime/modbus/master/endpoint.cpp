#include "runtime/modbus/master/endpoint.h"

namespace stepwright::modbus::master {

std::string name_of(const Endpoint& endpoint) {
  if (const auto* line = std::get_if<SerialEndpoint>(&endpoint)) return line->device;
  const auto& tcp = std::get<TcpEndpoint>(endpoint);
  const bool version6 = tcp.host.find(':') != std::string::npos;
  return (version6 ? "[" + tcp.host + "]" : tcp.host) + ":" + std::to_string(tcp.port);
}

std::chrono::microseconds frame_gap(std::uint32_t baud) {
  constexpr std::uint32_t kFastest = 19'200;
  constexpr std::uint64_t kBitsTimesMicro = 38'500'000;  // 3.5 characters of 11 bits
  if (baud == 0 || baud > kFastest) return std::chrono::microseconds(1'750);
  return std::chrono::microseconds((kBitsTimesMicro + baud - 1) / baud);
}

}  // namespace stepwright::modbus::master
