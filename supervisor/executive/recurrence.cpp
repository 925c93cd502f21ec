#include "supervisor/executive/recurrence.h"

namespace stepwright::executive {
namespace {

// Twice may be chance, as with a disturbance that passes.
constexpr int kInVain = 3;

}  // namespace

bool Recurrence::in_vain(const std::string& signature, std::size_t left) {
  Answered& answered = answered_[signature];
  if (answered.times == 0 || left < answered.least) {
    answered = {1, left};
    return false;
  }
  return ++answered.times >= kInVain;
}

}  // namespace stepwright::executive
