#pragma once

// Drives a train along a route in closed loop, forwards: pure pursuit (R. C. Coulter 1992) within the limits
// of steering and speed, checked at each step of the integration for walls, itself and the task.
//
// Thread rule: one thread at a time; what it borrows must outlive it. Example:
//   Driver driver(model, shape, walls, places, states);
//   const Drive drive = driver.along(route, driver.stand(state, task), {.lookahead_m = 1.0});
//   if (drive.end == DriveEnd::Done) ...

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "supervisor/ltl/route/route_search.h"
#include "supervisor/ltl/train/train_motion.h"
#include "supervisor/ltl/train/train_plan.h"

namespace stepwright::ltl {

struct DriveStyle {
  double lookahead_m = 1.0;
  double tightest_m = 1.0;  // radius of the tightest turn
  double cruise_m_s = 1.5;
  double slowing = 2.5;  // in bends: what is driven slowly is turned more tightly, as steering takes its time
  int side = 0;          // of turns to what lies behind: 1 left, -1 right, 0 the shorter one
};

// A state on the way, and what is left of the route from there.
struct DriveMark {
  TrainState state{};
  std::uint32_t task = 0;
  Label label = 0;         // that was read last
  std::size_t pieces = 0;  // that lead here
  double length_m = 0.0;   // driven so far
  double left_m = 0.0;     // of the route
  std::size_t next = 1;    // the route's point that is headed for
  std::size_t seen = 0;    // changes of the task on the way to it that have come already
};

enum class DriveEnd : std::uint8_t {
  Done,     // the task is accepted
  Blocked,  // the next step meets a wall or the train itself
  Broken,   // the next step breaks the task
  Astray,   // a state of the task that the route does not have: another route must be found
  Stuck,    // it circles around the next point, or a bound was met
  Over,     // the end of the route
  Slower,   // who asked has seen enough of it
  Stopped,  // the time is over, or nobody wants it any more
};

struct Drive {
  DriveEnd end = DriveEnd::Over;
  std::size_t blocked_link = 0;  // of Blocked: which one met a wall; the middle one, if it was another link
  std::vector<TrainPiece> pieces;
  std::vector<DriveMark> marks;  // the last one is where it ended
};

class Driver {
 public:
  // `shape` has the links' size for what they must not meet: a little more than the model's.
  Driver(const TrainModel& model, const TrainModel& shape, const Walls& walls, const Places& places,
         TaskStates states)
      : model_(model), shape_(shape), walls_(walls), places_(places), states_(std::move(states)) {}

  // Where a drive may begin: the task's state has read the label there.
  DriveMark stand(const TrainState& state, std::uint32_t task) const;

  // Whether a drive is given up there, asked about each metre.
  using Doubt = std::function<bool(const DriveMark&)>;

  // Requires a route that is not empty; `from` counts as length 0.
  Drive along(const Route& route, const DriveMark& from, const DriveStyle& style, const Doubt& doubt = {});

  // One control from there: marks as above. Ends with Over where nothing stops it.
  Drive hold(const DriveMark& from, const TrainControl& control, double duration_s);

  // Looked at each 0.1 s of a drive.
  void set_stop(const Stop& stop) { stop_ = stop; }
  bool valid(const TrainState& state) const { return !blocked(state); }
  std::uint64_t steps() const { return steps_; }

 private:
  enum class Event : std::uint8_t { None, Changed, Done, Blocked, Broken };

  std::optional<std::size_t> blocked(const TrainState& state) const;
  Event advance(TrainMotion& motion, const TrainControl& control, double duration_s, DriveMark& at,
                Drive& drive);

  const TrainModel& model_;
  const TrainModel& shape_;
  const Walls& walls_;
  const Places& places_;
  TaskStates states_;
  Stop stop_;
  std::vector<Label> letters_;
  std::vector<std::uint32_t> changes_;
  std::uint64_t steps_ = 0;
};

}  // namespace stepwright::ltl
