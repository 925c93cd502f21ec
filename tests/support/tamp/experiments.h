#pragma once

// The two experiments of F. Lagriffoul, L. Karlsson, A. Saffiotti 2012 as seeded problems, for two arms of
// our own whose numbers are published here: the paper's robot, table and trays are not. The same seed is the
// same problem on every machine.
//
// Tables of reach are owned by the arms, which outlive the problems. One thread at a time.

#include <cstdint>
#include <random>
#include <vector>

#include "supervisor/tamp/intervals/reach/column_arm.h"
#include "supervisor/tamp/intervals/search/instances.h"
#include "supervisor/tamp/intervals/sequence/work_cell.h"

namespace stepwright::tamp::testing {

// Uniform numbers that are the same everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double from_to(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }

 private:
  std::mt19937_64 engine_;
};

struct TwoArms {
  ColumnArm right, left;
  ReachTable right_table, left_table;

  const ColumnArm& model(std::size_t arm) const { return arm == 0 ? right : left; }
};

// Cells of that width. `flip_rad` as of ColumnArm: hands that also reach turned around.
TwoArms two_arms(double cell_m, double flip_rad = 0.0);

struct Problem {
  WorkCell cell;
  std::vector<Action> sequence;
  Discretisation how;
};

// Arm 0 is the right one, 1 the left one; grasp 0 is from above, 34 cm.
inline constexpr std::size_t kRight = 0, kLeft = 1;

// One arm: pick, place on tray1, pick, place on tray2 with a final angle of pi; tray1 is 10 to 40 cm high.
Problem experiment_1(const TwoArms& arms, std::uint64_t seed);
// Both arms: pick right, place on the table, move away, pick left, place on tray1 with a final angle.
Problem experiment_2(const TwoArms& arms, std::uint64_t seed);

}  // namespace stepwright::tamp::testing
