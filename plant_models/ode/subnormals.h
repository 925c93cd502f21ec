#pragma once

// Numbers below 2.2e-308 are zero while an object of this class lives, on this thread: what decays to nothing
// (a tank that is emptied) would else be computed with numbers that take processors a hundred times as long.
// What was set before holds again afterwards. x86-64 and AArch64; elsewhere nothing happens.

#include <cstdint>

namespace stepwright::ode {

class SubnormalsFlushed {
 public:
  SubnormalsFlushed();
  ~SubnormalsFlushed();
  SubnormalsFlushed(const SubnormalsFlushed&) = delete;
  SubnormalsFlushed& operator=(const SubnormalsFlushed&) = delete;

 private:
  std::uint64_t before_;
};

}  // namespace stepwright::ode
