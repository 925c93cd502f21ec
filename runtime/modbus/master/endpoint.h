#pragma once

// Endpoint of a slave: a TCP address, or a serial line that several share. Values; any thread. All of it is
// in this header: a configuration names endpoints and links no libmodbus.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

namespace stepwright::modbus::master {

// Framing of a request: the header of Modbus TCP, or unit and checksum as on a serial line (RTU over TCP, as
// some converters pass it on).
enum class Framing : std::uint8_t { Tcp, Rtu };

struct TcpEndpoint {
  std::string host =
      "127.0.0.1";  // IPv4, IPv6, or a name, whose look-up may block for as long as the resolver does
  std::uint16_t port = 502;
  Framing framing = Framing::Tcp;
  friend bool operator==(const TcpEndpoint&, const TcpEndpoint&) = default;
};

enum class Parity : std::uint8_t { None, Even, Odd };

// Defaults are those of Modbus over Serial Line V1.02, 2.5.1.
struct SerialEndpoint {
  std::string device = {};  // "/dev/ttyUSB0", a pty
  std::uint32_t baud = 19'200;
  Parity parity = Parity::Even;
  std::uint8_t data_bits = 8;  // 7 or 8
  std::uint8_t stop_bits = 1;  // 1 or 2
  bool rs485 = false;          // the kernel's driver switches the direction
  bool echo = false;           // the adapter repeats to this side all that it sends
  friend bool operator==(const SerialEndpoint&, const SerialEndpoint&) = default;
};

using Endpoint = std::variant<TcpEndpoint, SerialEndpoint>;

// "192.168.1.10:502", "[::1]:502", "/dev/ttyUSB0": one text for one connection.
inline std::string name_of(const Endpoint& endpoint) {
  if (const auto* line = std::get_if<SerialEndpoint>(&endpoint)) return line->device;
  const auto& tcp = std::get<TcpEndpoint>(endpoint);
  const bool version6 = tcp.host.find(':') != std::string::npos;
  return (version6 ? "[" + tcp.host + "]" : tcp.host) + ":" + std::to_string(tcp.port);
}

// The speeds that libmodbus sets; others it would silently replace.
inline constexpr std::array<std::uint32_t, 13> kSpeeds = {1'200,   2'400,   4'800,    9'600,   19'200,
                                                          38'400,  57'600,  115'200,  230'400, 460'800,
                                                          500'000, 921'600, 1'000'000};

// The silence between two frames: 3.5 characters of 11 bits, 1.75 ms above 19,200 baud (2.5.1.1).
constexpr std::chrono::microseconds frame_gap(std::uint32_t baud) {
  constexpr std::uint32_t kFastest = 19'200;
  constexpr std::uint64_t kBitsTimesMicro = 38'500'000;
  if (baud == 0 || baud > kFastest) return std::chrono::microseconds(1'750);
  return std::chrono::microseconds((kBitsTimesMicro + baud - 1) / baud);
}

// Time of so many characters on a line: a start bit, data, parity and stop bits each.
constexpr std::chrono::microseconds time_on(const SerialEndpoint& line, std::size_t characters) {
  constexpr std::uint64_t kMicro = 1'000'000;
  const std::uint64_t bits = 1u + line.data_bits + (line.parity == Parity::None ? 0u : 1u) + line.stop_bits;
  return std::chrono::microseconds(
      line.baud == 0 ? 0 : static_cast<std::int64_t>(characters * bits * kMicro / line.baud));
}

}  // namespace stepwright::modbus::master
