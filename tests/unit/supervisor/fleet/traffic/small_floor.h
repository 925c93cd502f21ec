#pragma once

// A floor of 44 x 26 m for tests of traffic: two aisles one above the other around a block of racks, bays in
// the walls below and above, and vehicles that drive as far as they may without a plant.

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "supervisor/fleet/traffic/floor_events.h"

namespace stepwright::fleet {

class SmallFloor {
 public:
  // `vehicles` up to 8, each resting in its bay.
  explicit SmallFloor(std::uint32_t vehicles);

  RoutePlanner& planner() { return *planner_; }
  Traffic& traffic() { return *traffic_; }
  FloorEvents& events() { return *events_; }
  std::chrono::milliseconds now() const { return now_; }

  // In the middle of the aisles, heading right; 0 to 3: below left, below right, above left, above right.
  static geometry::Pose station(std::uint32_t number);
  static Waypoint stop(const geometry::Pose& pose, const std::string& goal, int service_ms = 2000);
  // By way of the station or pose, then home.
  [[nodiscard]] result::Result<Change> send(std::uint32_t vehicle, std::uint32_t station);
  [[nodiscard]] result::Result<Change> send(std::uint32_t vehicle, const geometry::Pose& by);

  // Half a second: everybody drives on as far as it may, at 1 m/s, but those in `stand`.
  void tick(const std::set<std::uint32_t>& stand = {});
  // Until all that take part rest; false if that takes longer.
  bool settle(int ticks);
  // Checks the invariants; empty if they hold.
  std::string broken();
  // A new way is no permission taken back.
  void changed(std::uint32_t vehicle) { permitted_m_[vehicle] = 0.0; }

 private:
  std::unique_ptr<PrimitiveSet> primitives_;
  std::unique_ptr<HeuristicTable> table_;
  std::optional<RoutePlanner> planner_;
  std::optional<Traffic> traffic_;
  std::optional<FloorEvents> events_;
  std::vector<double> permitted_m_;
  std::vector<std::set<std::string>> served_;
  std::vector<std::chrono::milliseconds> standing_until_;
  std::chrono::milliseconds now_{0};
  std::uint32_t goals_ = 0;
};

}  // namespace stepwright::fleet
