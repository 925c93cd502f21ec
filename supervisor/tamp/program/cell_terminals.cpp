#include "supervisor/tamp/program/cell_terminals.h"

#include <fmt/format.h>

namespace stepwright::tamp::program {
namespace {

constexpr std::size_t kWordsOfArm = 8;
constexpr std::size_t kWordsOfSlot = 5;

std::string word(char area, std::size_t at) {
  return fmt::format("%{}W{}", area, at);
}
std::string bit(char area, std::size_t byte, int at) {
  return fmt::format("%{}X{}.{}", area, byte, at);
}
std::size_t input_words(std::size_t arms, std::size_t slots) {
  return kWordsOfArm * arms + 2 + kWordsOfSlot * slots;
}

}  // namespace

CellTerminals cell_terminals_in_a_row(std::size_t arms, std::size_t slots) {
  CellTerminals all;
  const std::size_t switches = 2 * input_words(arms, slots);
  const std::size_t relays = 2 * kWordsOfArm * arms;
  for (std::size_t arm = 0; arm < arms; ++arm) {
    ArmTerminals one;
    const std::size_t first = kWordsOfArm * arm;
    for (std::size_t k = 0; k < one.pos.size(); ++k) {
      one.pos[k] = word('I', first + k);
      one.set[k] = word('Q', first + k);
    }
    one.width = word('I', first + 7);
    one.grip = word('Q', first + 7);
    one.ready = bit('I', switches + arm, 0);
    one.trip = bit('I', switches + arm, 1);
    one.grasp = bit('I', switches + arm, 2);
    one.enable = bit('Q', relays + arm, 0);
    all.arms.push_back(std::move(one));
  }
  std::size_t next = kWordsOfArm * arms;
  all.camera_pictures = word('I', next++);
  all.camera_seen = word('I', next++);
  for (std::size_t slot = 0; slot < slots; ++slot) {
    all.slots.push_back({word('I', next), word('I', next + 1), word('I', next + 2), word('I', next + 3),
                         word('I', next + 4)});
    next += kWordsOfSlot;
  }
  all.estop_ok = bit('I', switches + arms, 0);
  all.camera_trigger = bit('Q', relays + arms, 0);
  return all;
}

std::size_t input_bytes_in_a_row(std::size_t arms, std::size_t slots) {
  return 2 * input_words(arms, slots) + arms + 1;
}

std::size_t output_bytes_in_a_row(std::size_t arms) {
  return 2 * kWordsOfArm * arms + arms + 1;
}

}  // namespace stepwright::tamp::program
