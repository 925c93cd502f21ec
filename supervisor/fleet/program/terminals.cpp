#include "supervisor/fleet/program/terminals.h"

#include <fmt/format.h>

namespace stepwright::fleet {
namespace {

constexpr std::size_t kInputWords = 5;
constexpr std::size_t kOutputWords = 2;

}  // namespace

FleetTerminals terminals_in_a_row(std::size_t vehicles) {
  FleetTerminals all;
  for (std::size_t v = 0; v < vehicles; ++v) {
    const std::size_t in = kInputWords * v;
    const std::size_t out = kOutputWords * v;
    const std::size_t switches = 2 * kInputWords * vehicles + v;
    const std::size_t relays = 2 * kOutputWords * vehicles + v;
    const auto word = [](char area, std::size_t at) { return fmt::format("%{}W{}", area, at); };
    const auto bit = [](char area, std::size_t byte, int at) {
      return fmt::format("%{}X{}.{}", area, byte, at);
    };
    all.vehicles.push_back({.x = word('I', in),
                            .y = word('I', in + 1),
                            .heading = word('I', in + 2),
                            .speed = word('I', in + 3),
                            .lock = word('I', in + 4),
                            .lifted = bit('I', switches, 0),
                            .lowered = bit('I', switches, 1),
                            .loaded = bit('I', switches, 2),
                            .bumper = bit('I', switches, 3),
                            .set_speed = word('Q', out),
                            .set_lock = word('Q', out + 1),
                            .enable = bit('Q', relays, 0),
                            .lift = bit('Q', relays, 1)});
  }
  all.estop_ok = fmt::format("%IX{}.0", input_bytes_in_a_row(vehicles) - 1);
  return all;
}

std::size_t input_bytes_in_a_row(std::size_t vehicles) {
  return (2 * kInputWords + 1) * vehicles + 1;
}

std::size_t output_bytes_in_a_row(std::size_t vehicles) {
  return (2 * kOutputWords + 1) * vehicles;
}

}  // namespace stepwright::fleet
