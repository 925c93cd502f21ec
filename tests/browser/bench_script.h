#pragma once

// A tank bench that follows a script instead of a program: what a viewer sees at any cell time, for tests of
// the HMI without a runtime. The plan is one of the bench's own, with its simultaneous branches.
//
// Pure values; any thread.

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "hmi_web/protocol/synoptic.h"
#include "hmi_web/server/point_reader.h"
#include "hmi_web/server/program_layout.h"

namespace stepwright::browser {

// All of it at once: the vehicle, the tanks, their sensors' raw counts, the pumps.
struct BenchInstant {
  double vehicle_position = 0;  // -1 at a1, 0 at f1, +1 at a2
  double level_v1 = 20;         // percent
  double level_a1 = 20;
  double level_a2 = 20;
  bool pump_b1 = false;
  bool pump_b2 = false;
  bool pump_b3 = false;
  bool pump_b4 = false;
  bool left = false;
  bool right = false;
  std::vector<bool> steps;  // by the program's steps
};

class BenchScript {
 public:
  BenchScript();

  const protocol::Program& program() const { return program_; }
  double end_s() const;
  BenchInstant at(double time_s) const;
  // The supervisor's plan document at that time.
  std::string plan_document(double time_s) const;

 private:
  void add_steps_and_transitions();

  protocol::Program program_;
  // Of every step: when it is active.
  std::vector<std::pair<double, double>> active_;
};

protocol::Synoptic bench_synoptic();

}  // namespace stepwright::browser
