#pragma once

// The baseline of bench_line: Box2D used directly, with the same walls, paddles and boxes, which are given
// the velocities that they had on the sorting line. No belts, drives or sensors.

#include <cstddef>
#include <memory>
#include <vector>

#include "plant_models/assemblies/line_parameters.h"

namespace stepwright::bench {

// Of one body in one step.
struct RecordedMotion {
  bool present = false;
  float x = 0.0f, y = 0.0f, angle = 0.0f;  // where it is at the beginning
  float vx = 0.0f, vy = 0.0f, spin = 0.0f;
};
// Boxes, then paddles, of every step of 5 ms.
using RecordedStep = std::vector<RecordedMotion>;

class PlainBox2d {
 public:
  explicit PlainBox2d(const assemblies::LineParameters& parameters);
  ~PlainBox2d();

  void step(const RecordedStep& motions);
  int contacts() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace stepwright::bench
