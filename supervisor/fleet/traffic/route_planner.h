#pragma once

// Ways through several stops on a floor that changes, with their envelopes and times.
//
// Any number of threads may plan at the same time; none may while another one blocks, unblocks or prepares.
// Each vehicle has a home, where it rests; homes are closed to all others. Places may
// be blocked for a time. Legs from stop to stop are planned once and kept until the floor changes where they
// lead, or where they might become shorter. The same calls give the same ways.
//
//   auto planner = RoutePlanner::create(floor, primitives, table, homes, {});
//   planner->prepare(stations, 2);
//   const auto route = planner->plan(3, from, std::array{at_shelf, at_dock, at_home});

#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "supervisor/fleet/lattice/path_planner.h"
#include "supervisor/fleet/traffic/route.h"

namespace stepwright::fleet {

struct RouteSettings {
  VehicleModel vehicle;   // its true outline
  double margin_m = 0.1;  // around it: what navigation and control may be off
  DriveLimits limits;
  EnvelopeOptions envelope{.growth_m = 0.2, .stretch_m = 3.0, .growth_step_m = 0.1, .speed = {}};
  double tail_m = 0.6;         // the last polygon of a leg holds no more of its way than this
  double tail_growth_m = 0.1;  // and grows by this, so that who rests there is in nobody's way
  double path_weight = 1.5;    // paths cost at most so many times the least
};

// A vehicle's outline as it is planned with: the true one and the margin.
VehicleModel with_margin(const RouteSettings& settings);

struct Waypoint {
  geometry::Pose pose;
  Stop stop;
};

struct HomePlace {
  std::string vehicle;
  geometry::Pose pose;
};

// Around a blocked place.
struct Room {
  geometry::ConvexPolygon area;
  bool closed = false;  // also where no other way leads past
};

class RoutePlanner {
 public:
  // `primitives` and `table` are those of the vehicle with its margin (`with_margin`), and must outlive the
  // planner. Fails with F0301.
  [[nodiscard]] static result::Result<RoutePlanner> create(OccupancyGrid floor,
                                                           const PrimitiveSet& primitives,
                                                           const HeuristicTable& table,
                                                           std::vector<HomePlace> homes,
                                                           const RouteSettings& settings);

  // From a pose of the lattice through the stops in their order; the last one is where the mission ends.
  // Fails with what the path planner and the envelope say, and F1001.
  [[nodiscard]] result::Result<Route> plan(std::uint32_t vehicle, const geometry::Pose& from,
                                           std::span<const Waypoint> stops);
  // A route of one pose: a vehicle that rests.
  [[nodiscard]] result::Result<Route> stand(std::uint32_t vehicle, const geometry::Pose& at);
  // Along a path that ends at a pose of the lattice, then as `plan`. The first half metre needs no more room
  // than the outline: for vehicles that stand anywhere.
  [[nodiscard]] result::Result<Route> plan_from(std::uint32_t vehicle, const geometry::Path& begin,
                                                std::span<const Waypoint> stops);

  // Works out what it costs to drive to these places from everywhere, on the floor without homes and blocked
  // places. A fraction of a second for each, shared by `threads`; from then on ways to them take a
  // millisecond instead of some tens. Places off the floor are left out.
  void prepare(std::span<const geometry::Pose> goals, unsigned threads);

  // Nobody is to drive there until it is unblocked; nor through the room around it, if it has any, where
  // another way leads to the stop, nor is a way to end in it. `block` returns a number to name it by.
  std::uint32_t block(const geometry::ConvexPolygon& area, std::optional<Room> room = {});
  // Others than this vehicle keep out of there, where another way leads to the stop.
  std::uint32_t avoid(std::uint32_t vehicle, const geometry::ConvexPolygon& area);
  void unblock(std::uint32_t number);
  // Whether the planned outline meets a blocked place there; or the room around one, or a place to avoid.
  bool meets_blocked(const geometry::Pose& pose) const;
  bool meets_room(const geometry::Pose& pose) const;

  double resolution_m() const { return primitives_->options().resolution_m; }
  const RouteSettings& settings() const { return settings_; }
  const geometry::Pose& home(std::uint32_t vehicle) const { return homes_[vehicle].pose; }
  const std::string& name(std::uint32_t vehicle) const { return homes_[vehicle].vehicle; }
  std::uint64_t paths_planned() const { return paths_planned_; }
  // Searches that looked at all that can be reached and found no way.
  std::uint64_t searches_in_vain() const { return in_vain_; }

 private:
  // The floor as one vehicle sees it, or, without a home, as it is for ways from station to station.
  struct Layer {
    std::unique_ptr<OccupancyGrid> grid;
    std::unique_ptr<PathPlanner> planner;
  };
  // Which rooms around blocked places one may drive through. All: who stands in one leaves it.
  enum class Rooms : std::uint8_t { None, NotClosed, All };
  struct LayerKey {
    std::uint32_t vehicle = 0;  // or nobody
    Rooms through = Rooms::None;
    auto operator<=>(const LayerKey&) const = default;
  };
  using Place = std::tuple<int, int, int>;            // of the lattice
  using LegKey = std::tuple<LayerKey, Place, Place>;  // start, goal
  struct Leg {
    Route route;
    std::uint64_t planned = 0;  // changes of the floor before
  };
  struct Blocked {
    std::optional<geometry::ConvexPolygon> area;
    std::optional<Room> room;
    std::optional<std::uint32_t> open_to;  // a vehicle
    std::uint64_t since = 0;

    // Nothing where it is open.
    const geometry::ConvexPolygon* closed_on(const LayerKey& layer) const {
      if (open_to == layer.vehicle) return nullptr;
      const Rooms least = room && room->closed ? Rooms::All : Rooms::NotClosed;
      if (room && layer.through < least) return &room->area;
      return area ? &*area : nullptr;
    }
  };

  RoutePlanner(OccupancyGrid floor, const PrimitiveSet& primitives, std::vector<HomePlace> homes,
               const RouteSettings& settings);
  std::uint32_t add(Blocked blocked);
  // Whether the planned outline meets a place of which `part` says what counts of it.
  template <typename Part>
  bool meets(const geometry::Pose& pose, Part&& part) const;
  // Whether a vehicle that rests there is in the room around a blocked place.
  bool rests_in_room(const geometry::Pose& pose) const;
  // Whose layer a leg is planned on.
  std::uint32_t layer_of(std::uint32_t vehicle, const geometry::Pose& from, const geometry::Pose& to) const;
  Place place_of(const geometry::Pose& pose) const;
  const Layer& layer(const LayerKey& key);
  PathAnswer path(const PathPlanner& planner, const geometry::Pose& from, const geometry::Pose& to) const;
  // Whether blocked places are known to keep the vehicle from getting there.
  bool enclosed(const LayerKey& on, const geometry::Pose& from, const geometry::Pose& to);
  // The last one does not end in a room.
  [[nodiscard]] result::Result<const Leg*> leg(std::uint32_t vehicle, const geometry::Pose& from,
                                               const geometry::Pose& to, bool last);
  [[nodiscard]] result::Result<const Leg*> leg_on(const LayerKey& on, std::uint32_t vehicle,
                                                  const geometry::Pose& from, const geometry::Pose& to);
  [[nodiscard]] result::Result<Route> leg_along(const OccupancyGrid& grid, geometry::Path path) const;
  [[nodiscard]] result::Result<Route> tight_leg(const OccupancyGrid& grid, const geometry::Path& path) const;
  [[nodiscard]] result::Result<Route> plan_behind(std::uint32_t vehicle, std::optional<Route> whole,
                                                  geometry::Pose at, std::span<const Waypoint> stops);
  std::vector<EnvelopePart> parts_from(const geometry::Path& path, std::size_t begin) const;

  std::unique_ptr<OccupancyGrid> floor_;
  const PrimitiveSet* primitives_;
  std::vector<HomePlace> homes_;
  RouteSettings settings_;
  VehicleModel planned_;
  std::optional<PathPlanner> base_;
  std::unique_ptr<FreeMotions> motions_;  // on the floor without homes; where it is the costs point to
  std::map<Place, CostToGo> costs_to_go_;
  std::unique_ptr<std::mutex> kept_ = std::make_unique<std::mutex>();  // guards the next six
  std::map<LayerKey, Layer> layers_;
  std::map<LegKey, Leg> legs_;
  std::uint64_t paths_planned_ = 0;
  // Goals to which some way was searched for in vain, and from where each is reached; until a place is free
  // again.
  std::set<Place> in_doubt_;
  std::map<std::pair<LayerKey, Place>, std::optional<Approaches>> approaches_;
  std::uint64_t in_vain_ = 0;
  std::map<std::uint32_t, Blocked> blocked_;
  std::uint64_t changes_ = 0;
  std::uint32_t next_block_ = 1;
};

}  // namespace stepwright::fleet
