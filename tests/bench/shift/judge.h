#pragma once

// Judges the true motion of the simulated vehicles without the planner: exact outlines against walls, against
// blocked places and against each other, at every step of the plant; and whether everybody who has somewhere
// to go gets there.
//
// One thread at a time. It reads poses and the drawn floor; of the planner it only asks for whom a vehicle
// that stands says it waits.
//
//   judge.step(now_s, poses);
//   judge.standing(now_s, states);   // every second
//   judge.collisions();

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "supervisor/map/occupancy_grid.h"
#include "tests/bench/shift/scenario.h"

namespace stepwright::bench::shift {

enum class Doing : std::uint8_t {
  Drives,
  Rests,
  Stands,
  Held,
  Dead,
  Waits
};  // Stands: at a stop, or somebody is in its way

struct VehicleState {
  Doing doing = Doing::Rests;
  std::optional<std::uint32_t> waits_for;
};

struct Collision {
  double time_s = 0.0;
  std::uint32_t vehicle = 0;
  std::string with;
};

class Judge {
 public:
  Judge(const Scenario& scenario, const geometry::Footprint& outline);

  void block(std::uint32_t place, bool blocked) { blocked_[place] = blocked; }
  void step(double now_s, std::span<const geometry::Pose> poses);
  void standing(double now_s, std::span<const geometry::Pose> poses, std::span<const VehicleState> states);

  // Each contact once, however long it lasts.
  const std::vector<Collision>& collisions() const { return collisions_; }
  // Circles of vehicles that wait for each other, and vehicles that stand for longer than kStuck_s although
  // nobody keeps them from going on.
  const std::vector<std::string>& deadlocks() const { return deadlocks_; }
  double longest_wait_s() const { return longest_wait_s_; }
  double smallest_gap_m() const { return smallest_gap_m_; }
  std::uint64_t checks() const { return checks_; }

  static constexpr double kStuck_s = 20.0;

 private:
  struct Box {  // an oriented rectangle
    geometry::Point middle;
    geometry::Point along;
    double half_length_m = 0.0;
    double half_width_m = 0.0;
  };
  Box box_of(const geometry::Pose& pose) const;
  static bool apart(const Box& a, const Box& b);
  static double gap_m(const Box& a, const Box& b);
  bool hits_wall(const Box& box) const;
  std::string endless_chain(double now_s, std::uint32_t vehicle, std::span<const VehicleState> states) const;
  void report(double now_s, std::uint32_t vehicle, std::uint32_t other, std::string with, bool touching);

  const Scenario& scenario_;
  geometry::Footprint outline_;
  std::vector<char> blocked_;
  std::vector<Box> places_;
  std::vector<Box> boxes_;
  std::vector<geometry::Pose> last_;
  std::vector<std::vector<char>> touching_;  // by vehicle: other vehicles, then the wall, then the places
  std::vector<double> still_since_s_, nameless_since_s_, idle_since_s_;
  std::vector<geometry::Pose> still_at_;
  std::vector<char> reported_;
  std::vector<Collision> collisions_;
  std::vector<std::string> deadlocks_;
  double longest_wait_s_ = 0.0;
  double smallest_gap_m_ = 1e9;
  std::uint64_t checks_ = 0;
};

}  // namespace stepwright::bench::shift
