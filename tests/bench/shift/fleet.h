#pragma once

// Fleet of a shift, with which routes are planned: the drawn hall, the first bays as homes, and how the
// plant's forklifts drive. One thread.
//
//   Fleet fleet(scenario, 20);
//   fleet.prepare();
//   auto traffic = fleet::Traffic::create(resting(fleet.planner(), 20), {}, now);

#include <memory>
#include <vector>

#include "supervisor/fleet/traffic/route_planner.h"
#include "tests/bench/shift/scenario.h"

namespace stepwright::bench::shift {

class Fleet {
 public:
  // `path_weight`: ways that are searched one by one cost at most so many times the least.
  Fleet(const Scenario& scenario, std::uint32_t vehicles,
        double path_weight = fleet::RouteSettings().path_weight);
  fleet::RoutePlanner& planner() { return *planner_; }
  const fleet::RouteSettings& settings() const { return settings_; }
  // Works out what ways to all stations and homes cost, so that all later ones are nearly the best there are.
  void prepare();
  // CPU time of the preparation.
  double prepare_cpu_s() const { return prepare_cpu_s_; }

 private:
  fleet::RouteSettings settings_;
  std::unique_ptr<fleet::PrimitiveSet> primitives_;
  std::unique_ptr<fleet::HeuristicTable> table_;
  std::unique_ptr<fleet::RoutePlanner> planner_;
  std::vector<geometry::Pose> goals_;
  double prepare_cpu_s_ = 0.0;
};

fleet::DriveLimits limits_of_the_plant();
std::vector<fleet::Route> resting(fleet::RoutePlanner& planner, std::uint32_t vehicles);

}  // namespace stepwright::bench::shift
