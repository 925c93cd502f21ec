#pragma once

// Dispatcher, which gives transports to vehicles: earliest due first, the nearest free vehicle. Knows the
// jobs, not how vehicles are moved: the simulated plant and the timed model share it.
//
// One thread at a time.
//
//   dispatcher.release(transport);
//   dispatcher.dispatch(now);           // vehicles get their missions
//   dispatcher.stood(vehicle, now_s);  // it has taken up or set down what it is there for

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "supervisor/fleet/traffic/floor_events.h"
#include "tests/bench/shift/figures.h"
#include "tests/bench/shift/scenario.h"

namespace stepwright::bench::shift {

struct FreeVehicle {
  std::uint32_t vehicle = 0;
  geometry::Pose place;
};

struct Waiting {
  std::uint32_t transport = 0;
  double due_s = 0.0;
  geometry::Pose from;
  std::span<const std::uint32_t> not_by = {};  // vehicles that found no way or no order a moment ago
};

// Who takes what. Answers pairs in the order in which they are to be tried.
class DispatchRule {
 public:
  virtual ~DispatchRule() = default;
  struct Choice {
    std::uint32_t transport = 0;
    std::uint32_t vehicle = 0;
  };
  virtual std::vector<Choice> choose(std::span<const Waiting> waiting,
                                     std::span<const FreeVehicle> free) const = 0;
};

class EarliestDueNearestVehicle final : public DispatchRule {
 public:
  std::vector<Choice> choose(std::span<const Waiting> waiting,
                             std::span<const FreeVehicle> free) const override;
};

class Dispatcher {
 public:
  Dispatcher(const Scenario& scenario, fleet::Traffic& traffic, fleet::RoutePlanner& planner,
             const DispatchRule& rule, ShiftFigures& figures);

  void release(std::uint32_t transport) { open_.push_back(transport); }
  void dispatch(std::chrono::milliseconds now);
  // Vehicles on their way home are not given another mission before they are there: fewer different ways to
  // plan.
  void only_standing() { only_standing_ = true; }
  // Whether the next standing is that of a job, and how long it really takes.
  double service_s(std::uint32_t vehicle) const;
  void stood(std::uint32_t vehicle, double now_s);
  void take(const std::vector<fleet::Detour>& detours);
  // Its job, if it is not loaded, goes to somebody else.
  void died(std::uint32_t vehicle);
  bool busy(std::uint32_t vehicle) const { return jobs_[vehicle].has_value(); }
  bool has_open() const { return !open_.empty(); }
  // Vehicles that got another way since the last call.
  std::vector<std::uint32_t> take_rerouted();

 private:
  struct Job {
    std::uint32_t transport = 0;
    bool loaded = false;
    bool given_up = false;  // its stops are not on the vehicle's way
  };
  bool assign(std::uint32_t vehicle, std::uint32_t transport, bool loaded, std::chrono::milliseconds now);
  fleet::Waypoint stop_at(std::uint32_t transport, bool set_down) const;

  const Scenario& scenario_;
  fleet::Traffic& traffic_;
  fleet::RoutePlanner& planner_;
  const DispatchRule& rule_;
  ShiftFigures& figures_;
  std::vector<std::uint32_t> open_;
  std::vector<std::optional<Job>> jobs_;
  std::vector<double> not_before_s_;                // by transport, after a refusal
  std::vector<std::vector<std::uint32_t>> not_by_;  // by transport: who was refused since it was given to one
  std::vector<std::uint32_t> rerouted_;
  bool only_standing_ = false;
};

}  // namespace stepwright::bench::shift
