#include "supervisor/fleet/vda5050/link/fleet_document.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>

#include "supervisor/fleet/vda5050/topic.h"

namespace stepwright::vda5050_link {

namespace {

using geometry::Travel;
using nlohmann::json;

// What is wrong, with its place; caught where the document is read.
struct Wrong : std::runtime_error {
  Wrong(const std::string& pointer, const std::string& what) : std::runtime_error(pointer + ": " + what) {}
};

std::string below(const std::string& pointer, const std::string& key) {
  return pointer + "/" + key;
}
std::string below(const std::string& pointer, std::size_t index) {
  return pointer + "/" + std::to_string(index);
}

const json& member(const json& object, const char* key, const std::string& pointer) {
  if (!object.is_object()) throw Wrong(pointer, "is no object");
  const auto found = object.find(key);
  if (found == object.end()) throw Wrong(pointer, std::string("lacks '") + key + "'");
  return *found;
}

const json& list(const json& object, const char* key, const std::string& pointer) {
  const json& found = member(object, key, pointer);
  if (!found.is_array()) throw Wrong(below(pointer, key), "is no list");
  return found;
}

std::string text(const json& object, const char* key, const std::string& pointer) {
  const json& found = member(object, key, pointer);
  if (!found.is_string()) throw Wrong(below(pointer, key), "is no text");
  return found.get<std::string>();
}

std::string optional_text(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

double number(const json& value, const std::string& pointer) {
  const double found = value.is_number() ? value.get<double>() : std::nan("");
  if (!std::isfinite(found) || std::abs(found) > 1e9) throw Wrong(pointer, "is no number within reason");
  return found;
}

std::size_t count(const json& object, const char* key, const std::string& pointer) {
  const json& found = member(object, key, pointer);
  if (!found.is_number_unsigned() || found.get<std::uint64_t>() > 1'000'000'000) {
    throw Wrong(below(pointer, key), "is no count");
  }
  return found.get<std::size_t>();
}

// A list of exactly `N` numbers.
template <std::size_t N>
std::array<double, N> numbers(const json& value, const std::string& pointer) {
  if (!value.is_array() || value.size() != N) {
    throw Wrong(pointer, "is no list of " + std::to_string(N) + " numbers");
  }
  std::array<double, N> found{};
  for (std::size_t k = 0; k < N; ++k) found[k] = number(value[k], below(pointer, k));
  return found;
}

std::size_t nearest(const geometry::Path& path, double arc_m) {
  const auto after = std::ranges::lower_bound(path, arc_m, {}, &geometry::PathPose::arc_m);
  if (after == path.begin()) return 0;
  if (after == path.end()) return path.size() - 1;
  const auto k = static_cast<std::size_t>(after - path.begin());
  return arc_m - path[k - 1].arc_m <= path[k].arc_m - arc_m ? k - 1 : k;
}

// Chords are a little shorter than the arcs between the poses: the whole is stretched to the way's length.
geometry::Path path_of(const json& entry, const std::string& pointer) {
  const json& poses = list(entry, "poses_m_m_deg", pointer);
  const std::string at = below(pointer, "poses_m_m_deg");
  if (poses.empty()) throw Wrong(at, "is empty");
  geometry::Path path;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const auto [x, y, heading] = numbers<3>(poses[k], below(at, k));
    geometry::PathPose next{{x, y, heading * std::numbers::pi / 180.0}, 0.0, Travel::Forward};
    if (!path.empty()) {
      const auto& before = path.back();
      const double dx = x - before.pose.x_m, dy = y - before.pose.y_m;
      const double along = dx * std::cos(before.pose.heading_rad) + dy * std::sin(before.pose.heading_rad);
      next.arc_m = before.arc_m + std::hypot(dx, dy);
      next.travel = std::abs(along) < 1e-6 ? before.travel : along < 0.0 ? Travel::Reverse : Travel::Forward;
    }
    path.push_back(next);
  }
  if (path.size() > 1) path.front().travel = path[1].travel;
  const double length = number(member(entry, "length_m", pointer), below(pointer, "length_m"));
  if (path.back().arc_m > 0.0) {
    const double stretch = length / path.back().arc_m;
    if (!(std::abs(stretch - 1.0) < 0.05)) throw Wrong(below(pointer, "length_m"), "is not the poses' way");
    for (auto& pose : path) pose.arc_m *= stretch;
  }
  return path;
}

std::vector<fleet::Stop> stops_of(const json& entry, const geometry::Path& path, const std::string& pointer) {
  const json& all = list(entry, "stops", pointer);
  std::vector<fleet::Stop> stops;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::string at = below(below(pointer, "stops"), k);
    fleet::Stop stop;
    const std::string kind = text(all[k], "kind", at);
    stop.kind = kind == "pick_up"    ? fleet::StopKind::PickUp
                : kind == "set_down" ? fleet::StopKind::SetDown
                : kind == "give_way" ? fleet::StopKind::GiveWay
                                     : fleet::StopKind::Park;
    stop.location = text(all[k], "location", at);
    stop.goal = optional_text(all[k], "goal");
    stop.amount = static_cast<std::uint32_t>(count(all[k], "amount", at));
    stop.arc_m = number(member(all[k], "arc_m", at), below(at, "arc_m"));
    stop.pose = nearest(path, stop.arc_m);
    if (!stops.empty() && stop.pose < stops.back().pose) throw Wrong(at, "comes before the stop above it");
    stops.push_back(std::move(stop));
  }
  return stops;
}

fleet::GrownEnvelope envelope_of(const json& entry, const geometry::Path& path, const std::string& pointer) {
  const json& all = list(entry, "polygons", pointer);
  const std::string polygons = below(pointer, "polygons");
  if (all.empty()) throw Wrong(polygons, "is empty");
  fleet::GrownEnvelope grown;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::string at = below(polygons, k);
    std::vector<geometry::Point> corners;
    const json& given = list(all[k], "corners_m", at);
    for (std::size_t c = 0; c < given.size(); ++c) {
      const auto [x, y] = numbers<2>(given[c], below(below(at, "corners_m"), c));
      corners.push_back({x, y});
    }
    auto area = geometry::ConvexPolygon::hull(corners);
    if (!area) throw Wrong(below(at, "corners_m"), "has no area");
    const auto [entry_m, exit_m] = numbers<2>(member(all[k], "way_m", at), below(at, "way_m"));
    grown.envelope.polygons.push_back({*std::move(area), {}, {}});
    grown.visits.push_back({nearest(path, entry_m), nearest(path, exit_m), entry_m, exit_m, {}});
    const bool ordered =
        k == 0 || (entry_m >= grown.visits[k - 1].entry_m && entry_m <= grown.visits[k - 1].exit_m + 0.01);
    if (!ordered || exit_m < entry_m)
      throw Wrong(below(at, "way_m"), "does not go on where the way has come to");
  }
  return grown;
}

class Reader {
 public:
  Reader(const json& fleet, const DataOf& data) : fleet_(fleet), data_(data) {}

  FleetDocument read() {
    const std::string root = "/fleet";
    document_.revision = count(fleet_, "revision", root);
    const json& vehicles = list(fleet_, "vehicles", root);
    for (std::size_t v = 0; v < vehicles.size(); ++v) {
      add_vehicle(vehicles[v], below(below(root, "vehicles"), v));
    }
    if (document_.vehicles.empty()) throw Wrong(below(root, "vehicles"), "is empty");
    const bool scheduled = text(fleet_, "verdict", root) == "scheduled";
    document_.plan.schedule.verdict = scheduled ? fleet::Verdict::Scheduled : fleet::Verdict::Exhausted;
    const json& orders = list(fleet_, "precedences", root);
    for (std::size_t k = 0; k < orders.size(); ++k) {
      const std::string at = below(below(root, "precedences"), k);
      const auto first = polygon(member(orders[k], "first", at), below(at, "first"));
      document_.plan.schedule.precedences.push_back(
          {first, polygon(member(orders[k], "second", at), below(at, "second"))});
    }
    return std::move(document_);
  }

 private:
  // The entry of `lists` for this vehicle.
  const json& entry_of(const char* lists, const std::string& name, std::string& pointer) const {
    const json& all = list(fleet_, lists, "/fleet");
    for (std::size_t k = 0; k < all.size(); ++k) {
      pointer = below(below("/fleet", lists), k);
      if (text(all[k], "vehicle", pointer) == name) return all[k];
    }
    throw Wrong(below("/fleet", lists), "has nothing of the vehicle '" + name + "'");
  }

  void add_vehicle(const json& entry, const std::string& pointer) {
    DocumentVehicle vehicle;
    vehicle.name = text(entry, "vehicle", pointer);
    vehicle.variable = text(entry, "variable", pointer);
    vehicle.state = optional_text(entry, "state");
    vehicle.reason = optional_text(entry, "reason");
    if (entry.contains("stops_done")) vehicle.stops_done = count(entry, "stops_done", pointer);
    fleet::vda5050::Address address;
    address.serial_number = vehicle.name;
    vehicle.serial_number = check(address).empty() ? vehicle.name : vehicle.variable;
    if (!index_.emplace(vehicle.name, document_.vehicles.size()).second) {
      throw Wrong(pointer, "another vehicle is called '" + vehicle.name + "', too");
    }
    const VehicleData data = data_(vehicle.variable);
    fleet::VehicleMission mission;
    mission.vehicle = vehicle.serial_number;
    mission.model = data.model;
    mission.speed.max_mps = data.max_mps;
    std::string at;
    const json& path = entry_of("paths", vehicle.name, at);
    mission.path = path_of(path, at);
    mission.stops = stops_of(path, mission.path, at);
    const json& polygons = entry_of("polygons", vehicle.name, at);
    mission.grown = envelope_of(polygons, mission.path, at);
    mission.grown.envelope.vehicle = vehicle.serial_number;
    document_.plan.missions.push_back(std::move(mission));
    document_.vehicles.push_back(std::move(vehicle));
  }

  fleet::PolygonRef polygon(const json& at, const std::string& pointer) const {
    const auto vehicle = index_.find(text(at, "vehicle", pointer));
    if (vehicle == index_.end()) throw Wrong(below(pointer, "vehicle"), "is no vehicle of the fleet");
    const std::size_t polygon = count(at, "polygon", pointer);
    if (polygon >= document_.plan.missions[vehicle->second].grown.visits.size()) {
      throw Wrong(below(pointer, "polygon"), "is no polygon of that vehicle");
    }
    return {static_cast<std::uint32_t>(vehicle->second), static_cast<std::uint32_t>(polygon)};
  }

  const json& fleet_;
  const DataOf& data_;
  FleetDocument document_;
  std::map<std::string, std::size_t> index_;
};

}  // namespace

result::Result<PlanDocument> read_plan_document(const std::string& text, const std::string& source,
                                                const DataOf& data) {
  const json root = json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!root.is_object()) return result::fail("F0911", {source, 0, 0}, "is no JSON object");
  PlanDocument document{.program_digest = optional_text(root, "program_digest"),
                        .phase = optional_text(root, "phase"),
                        .fleet = std::nullopt};
  const auto found = root.find("fleet");
  if (found == root.end() || !found->is_object()) return document;
  try {
    document.fleet = Reader(*found, data).read();
  } catch (const Wrong& wrong) {
    return result::fail("F0911", {source, 0, 0}, wrong.what(),
                        "supervisor and publisher have to be of the same version");
  }
  return document;
}

}  // namespace stepwright::vda5050_link
