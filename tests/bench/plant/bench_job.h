#pragma once

// A job that keeps every part of the tank bench busy for as long as one likes: load, go to a1, unload, go on
// to a2, unload, return; the customers draw while the vehicle travels. It reads the true levels, so that
// it needs no filter, and is to be asked once per scan.

#include <array>
#include <cstdint>

#include "plant_models/core/plant.h"

namespace stepwright::bench {

// In the order of the plant's actuators: B1, B2, B3, B4, drive_left, drive_right.
using Outputs = std::array<bool, 6>;

class Job {
 public:
  // The outputs for the next scan of 10 ms.
  Outputs next(const core::Plant& plant);

  // Round trips completed.
  int rounds() const { return rounds_; }

 private:
  enum class Phase : std::uint8_t { Load, ToA1, UnloadA1, ToA2, UnloadA2, ToF1 };

  void go(Phase phase);

  Phase phase_ = Phase::Load;
  int pause_ = 0;  // scans of rest that let the pumps run down
  int rounds_ = 0;
  bool draws_a1_ = false;
  bool draws_a2_ = false;
};

// Puts the outputs on the plant.
void operate(const Outputs& outputs, core::Plant& plant);

}  // namespace stepwright::bench
