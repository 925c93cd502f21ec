#include "supervisor/ltl/program/train_terminals.h"

#include <fmt/format.h>

namespace stepwright::ltl {

TrainTerminals train_terminals_in_a_row(std::size_t trailers, std::size_t places) {
  std::size_t words = 0;
  const auto word = [&] { return fmt::format("%IW{}", words++); };
  TrainTerminals made;
  for (std::string* each : {&made.x, &made.y, &made.heading, &made.speed, &made.lock}) *each = word();
  for (std::size_t k = 0; k < trailers; ++k) made.hitches.push_back(word());
  made.trailers = word();
  std::size_t byte = 2 * words;
  made.bumper = fmt::format("%IX{}.0", byte);
  made.estop_ok = fmt::format("%IX{}.1", byte);
  made.way_free = fmt::format("%IX{}.2", byte);
  ++byte;
  for (std::size_t k = 0; k < places; ++k) made.at.push_back(fmt::format("%IX{}.{}", byte + k / 8, k % 8));
  made.set_speed = "%QW0";
  made.set_lock = "%QW1";
  made.enable = "%QX4.0";
  return made;
}

}  // namespace stepwright::ltl
