#include "tests/support/tamp/experiments.h"

#include <numbers>

namespace stepwright::tamp::testing {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTop_m = 0.34;  // of the tool above a cup
constexpr double kCup_m = 0.05;  // of a cup's origin above what it stands on

WorkCell two_armed_cell(const TwoArms& arms) {
  WorkCell cell;
  cell.arms = {{"right", &arms.right_table}, {"left", &arms.left_table}};
  cell.grasps = {{"top", kTop_m, 0.0, {}}};
  return cell;
}

}  // namespace

TwoArms two_arms(double cell_m, double flip_rad) {
  ColumnArm right{.x_m = 0.0,
                  .y_m = -0.22,
                  .z_m = 0.55,
                  .least_m = 0.25,
                  .easy_m = 0.38,
                  .most_m = 0.8,
                  .lean_rad = -0.2,
                  .turn_rad = 1.2,
                  .flip_rad = flip_rad};
  ColumnArm left = right;
  left.y_m = 0.22;
  left.lean_rad = 0.2;
  return {right, left, reach_table(right, cell_m), reach_table(left, cell_m)};
}

Problem experiment_1(const TwoArms& arms, std::uint64_t seed) {
  Random random(seed);
  Problem problem{two_armed_cell(arms), {}, {}};
  WorkCell& cell = problem.cell;
  cell.objects = {{"cup1",
                   {random.from_to(0.4, 0.7), random.from_to(-0.5, 0.0), kCup_m, random.from_to(-kPi, kPi)},
                   0.1}};
  cell.regions = {{"tray1", random.from_to(0.45, 1.0), random.from_to(-0.7, 0.2),
                   random.from_to(0.1, 0.4) + kCup_m, 0.3, 0.3, 0.0},
                  {"tray2", 0.5, -0.1, kCup_m, 0.3, 0.3, 0.0}};
  problem.sequence = {pick(kRight, 0), place(kRight, 0, 0), pick(kRight, 0), place(kRight, 0, 1, kPi)};
  problem.how = {{0.05, 0.05}, 16};
  return problem;
}

Problem experiment_2(const TwoArms& arms, std::uint64_t seed) {
  Random random(seed);
  Problem problem{two_armed_cell(arms), {}, {}};
  WorkCell& cell = problem.cell;
  cell.objects = {
      {"cup1",
       {random.from_to(0.35, 0.7), random.from_to(-0.65, -0.2), kCup_m, random.from_to(-kPi, kPi)},
       0.1}};
  cell.regions = {{"tray1", random.from_to(0.4, 1.0), random.from_to(0.2, 0.8), kCup_m, 0.3, 0.3, 0.0},
                  {"table", 0.5, 0.0, kCup_m, 0.6, 1.2, 0.0}};
  const double final_rad = 2.0 * kPi / 16.0 * static_cast<double>(random.below(16)) - kPi;
  problem.sequence = {pick(kRight, 0), place(kRight, 0, 1), move_away(kRight), pick(kLeft, 0),
                      place(kLeft, 0, 0, final_rad)};
  problem.how = {{0.05, 0.15}, 16};
  return problem;
}

}  // namespace stepwright::tamp::testing
