#pragma once

// Measured cost of a monitor of a cell in every scan: the first task of E. Plaku (AAAI 2012 workshop, section
// 2.5) over eight places, in both engines, beside the same program without it and beside the same rule as
// people write it, a CASE of IFs that knows that places do not overlap. The verdicts are compared before
// anything is timed; all take turns.
//
// One thread. Throws std::runtime_error where programs do not compile or verdicts differ.
//
//   for (const EngineCost& each : monitor_cost()) std::printf("%s %.3f us\n", each.engine, each.monitor_us);

#include <vector>

namespace stepwright::bench {

struct EngineCost {
  const char* engine;
  // Of a scan, of the passes that other processes have disturbed least.
  double monitor_us = 0.0;
  double by_hand_us = 0.0;
  double without_us = 0.0;  // the program alone
};

// Of machine code and of the interpreter.
std::vector<EngineCost> monitor_cost();
// Of the engine that takes longer.
double most_us(const std::vector<EngineCost>& costs);

}  // namespace stepwright::bench
