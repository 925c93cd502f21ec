#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

#include "supervisor/fleet/traffic/internal/lane.h"
#include "supervisor/geometry/box_pairs.h"

namespace stepwright::fleet::internal {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds kHorizon{kHorizon_ms};
// So that a circle of vehicles that wait for each other is never of length zero.
constexpr milliseconds kLeastOverlap{1};

milliseconds whole(double seconds) {
  return milliseconds(static_cast<milliseconds::rep>(std::ceil(1e3 * std::max(0.0, seconds))));
}

// From where the vehicle is, with what it still has to stand.
TrajectoryEnvelope envelope_of(const Lane& lane, milliseconds now) {
  const Route& route = lane.route;
  TrajectoryEnvelope rest;
  rest.vehicle = route.mission.vehicle;
  const milliseconds standing = std::max(milliseconds(0), lane.standing_until - now);
  const double here_s = route.pace.time_s(lane.arc_m, true);
  for (std::uint32_t k = lane.first; k < route.polygons(); ++k) {
    EnvelopePolygon polygon{route.mission.grown.envelope.polygons[k].area, {}, {}};
    const double from_s = std::max(here_s, route.needed_s[k]);
    polygon.stay = {whole(route.left_s[k] - from_s) + kLeastOverlap, kHorizon};
    if (k == lane.first) polygon.stay.least += standing;
    if (k + 1 < route.polygons()) {
      const double next_s = std::max(here_s, route.needed_s[k + 1]);
      const milliseconds both = whole(route.left_s[k] - next_s) + kLeastOverlap;
      polygon.overlap = {std::min(both, polygon.stay.least), kHorizon};
    }
    rest.polygons.push_back(std::move(polygon));
  }
  return rest;
}

bool takes_part(const Lane& lane) {
  return !lane.removed;
}

std::vector<std::uint32_t> rows_of(std::span<const Lane* const> lanes) {
  std::vector<std::uint32_t> rows(lanes.size(), 0);
  std::uint32_t next = 0;
  for (std::uint32_t v = 0; v < lanes.size(); ++v)
    if (takes_part(*lanes[v])) rows[v] = next++;
  return rows;
}

TemporalConstraint after(PolygonRef first, PolygonRef second) {
  return {.name = {},
          .from = TimepointRef{first, Side::Exit},
          .to = {second, Side::Entry},
          .distance = {milliseconds(0), kHorizon}};
}

// Nobody enters this polygon before he may enter the next one.
TemporalConstraint together(PolygonRef at) {
  return {.name = {},
          .from = TimepointRef{{at.vehicle, at.polygon + 1}, Side::Entry},
          .to = {at, Side::Entry},
          .distance = {milliseconds(0), kHorizon}};
}

}  // namespace

Remainder remainder_of(std::span<const Lane* const> lanes, milliseconds now, milliseconds held) {
  Remainder remainder;
  for (std::uint32_t v = 0; v < lanes.size(); ++v) {
    const Lane& lane = *lanes[v];
    if (!takes_part(lane)) continue;
    const auto row = static_cast<std::uint32_t>(remainder.vehicles.size());
    remainder.vehicles.push_back(v);
    remainder.envelopes.push_back(envelope_of(lane, now));
    for (std::uint32_t k = lane.granted; k + 1 < lane.route.polygons(); ++k) {
      if (lane.route.needed_m[k] == lane.route.needed_m[k + 1])
        remainder.constraints.push_back(together({row, k - lane.first}));
    }
    if (!lane.limit_m) continue;
    const std::uint32_t stands_in = polygon_at(lane.route, lane.first, *lane.limit_m);
    remainder.constraints.push_back({.name = {},
                                     .from = {},
                                     .to = {{row, stands_in - lane.first}, Side::Exit},
                                     .distance = {held, kHorizon}});
  }
  return remainder;
}

std::vector<SpatialPair> overlaps_ahead(std::span<const Lane* const> lanes,
                                        std::span<const SpatialPair> known,
                                        std::optional<std::uint32_t> changed) {
  std::vector<geometry::Box> boxes;
  std::vector<std::uint32_t> groups;
  std::vector<PolygonRef> places;
  const auto area = [&](PolygonRef at) -> const geometry::ConvexPolygon& {
    return lanes[at.vehicle]->route.mission.grown.envelope.polygons[at.polygon].area;
  };
  for (std::uint32_t v = 0; v < lanes.size(); ++v) {
    if (!takes_part(*lanes[v])) continue;
    for (std::uint32_t k = lanes[v]->first; k < lanes[v]->route.polygons(); ++k) {
      places.push_back({v, k});
      boxes.push_back(area(places.back()).bounds());
      // All that has not changed is one group: what overlaps within it is known.
      groups.push_back(!changed ? v : v == *changed ? 1 : 0);
    }
  }
  std::vector<SpatialPair> ahead;
  for (const auto& [i, k] : geometry::overlapping_boxes(boxes, groups))
    if (geometry::overlaps(area(places[i]), area(places[k]))) ahead.push_back({places[i], places[k]});
  const auto still_ahead = [&](PolygonRef at) {
    return at.vehicle != changed && takes_part(*lanes[at.vehicle]) && at.polygon >= lanes[at.vehicle]->first;
  };
  if (changed) {
    std::ranges::copy_if(known, std::back_inserter(ahead),
                         [&](const SpatialPair& pair) { return still_ahead(pair.a) && still_ahead(pair.b); });
  }
  std::ranges::sort(ahead, {}, [](const SpatialPair& p) {
    return std::tuple(p.a.vehicle, p.b.vehicle, p.a.polygon, p.b.polygon);
  });
  return ahead;
}

std::vector<SpatialPair> by_row(std::span<const Lane* const> lanes, std::span<const SpatialPair> ahead) {
  const std::vector<std::uint32_t> rows = rows_of(lanes);
  const auto placed = [&](PolygonRef at) {
    return PolygonRef{rows[at.vehicle], at.polygon - lanes[at.vehicle]->first};
  };
  std::vector<SpatialPair> pairs;
  pairs.reserve(ahead.size());
  for (const SpatialPair& pair : ahead) pairs.push_back({placed(pair.a), placed(pair.b)});
  return pairs;
}

void keep_permissions(std::span<const Lane* const> lanes, std::span<const SpatialPair> rows,
                      Remainder& remainder) {
  const auto permitted = [&](PolygonRef at) {
    const Lane& lane = *lanes[remainder.vehicles[at.vehicle]];
    return lane.first + at.polygon < lane.granted;
  };
  for (const SpatialPair& pair : rows) {
    // The first polygons come first anyway.
    if (permitted(pair.a) && pair.a.polygon > 0) remainder.constraints.push_back(after(pair.a, pair.b));
    if (permitted(pair.b) && pair.b.polygon > 0) remainder.constraints.push_back(after(pair.b, pair.a));
  }
}

void keep_orders(std::span<const Lane* const> lanes, std::uint32_t changed, Remainder& remainder) {
  const std::vector<std::uint32_t> rows = rows_of(lanes);
  for (std::uint32_t v = 0; v < lanes.size(); ++v) {
    const Lane& lane = *lanes[v];
    if (!takes_part(lane) || v == changed) continue;
    for (const Wait& wait : lane.waits) {
      const Lane& other = *lanes[wait.vehicle];
      if (!takes_part(other) || wait.vehicle == changed) continue;
      if (wait.left < other.first || wait.polygon < lane.granted) continue;
      remainder.constraints.push_back(
          after({rows[wait.vehicle], wait.left - other.first}, {rows[v], wait.polygon - lane.first}));
    }
  }
}

}  // namespace stepwright::fleet::internal
