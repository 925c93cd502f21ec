#include "supervisor/fleet/schedule/problem_file.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "supervisor/fleet/network/constraint.h"
#include "supervisor/fleet/schedule/json_place.h"

namespace stepwright::fleet {

namespace {

using nlohmann::json;
using std::chrono::milliseconds;

constexpr std::size_t kMostCorners = 64;
constexpr double kFarthest_m = 1e6;

// Thrown to end the reading at the first problem; never leaves this file.
using Rejected = KeyProblem;

[[noreturn]] void reject(const char* code, const std::string& key, const std::string& what,
                         const std::string& hint = {}) {
  throw Rejected{code, key, what, hint};
}

std::string item(const std::string& key, std::size_t index) {
  return key + "[" + std::to_string(index) + "]";
}

const json& member(const json& object, const std::string& key, const char* name) {
  if (!object.is_object()) reject("F0602", key, "is no object");
  const auto found = object.find(name);
  if (found == object.end()) reject("F0602", key, std::string("lacks '") + name + "'");
  return *found;
}

const json& list(const json& object, const std::string& key, const char* name) {
  const json& found = member(object, key, name);
  if (!found.is_array()) reject("F0602", key.empty() ? name : key + "." + name, "is no list");
  return found;
}

std::string text_of(const json& object, const std::string& key, const char* name) {
  const json& found = member(object, key, name);
  if (!found.is_string() || found.get_ref<const std::string&>().empty()) {
    reject("F0602", key + "." + name, "is no text, or an empty one");
  }
  return found.get<std::string>();
}

void only(const json& object, const std::string& key, std::initializer_list<const char*> names) {
  if (!object.is_object()) reject("F0602", key, "is no object");
  for (const auto& [name, value] : object.items()) {
    const bool known = std::ranges::any_of(names, [&name = name](const char* n) { return name == n; });
    if (!known) reject("F0602", key.empty() ? name : key + "." + name, "is not known here");
  }
}

milliseconds time_of(const json& value, const std::string& key, std::int64_t least) {
  const bool whole = value.is_number_unsigned()
                         ? value.get<std::uint64_t>() <= kHorizon_ms
                         : value.is_number_integer() && value.get<std::int64_t>() <= kHorizon_ms;
  if (!whole || value.get<std::int64_t>() < least) {
    reject("F0604", key,
           "is no whole number of milliseconds from " + std::to_string(least) + " to 100000000");
  }
  return milliseconds(value.get<std::int64_t>());
}

// [least, most]; null for a most that binds nothing.
Bounds bounds_of(const json& value, const std::string& key, std::int64_t least) {
  if (!value.is_array() || value.size() != 2) reject("F0604", key, "is no pair [least, most]");
  Bounds bounds{time_of(value[0], item(key, 0), least), milliseconds(kHorizon_ms)};
  if (!value[1].is_null()) bounds.most = time_of(value[1], item(key, 1), least);
  if (bounds.most < bounds.least) {
    reject("F0604", key, "has a most below its least", "write [least, most], or null for no most");
  }
  return bounds;
}

double coordinate(const json& value, const std::string& key) {
  if (!value.is_number() || !(std::abs(value.get<double>()) <= kFarthest_m)) {
    reject("F0603", key, "is no coordinate within 1000 km");
  }
  return value.get<double>();
}

geometry::ConvexPolygon area_of(const json& corners, const std::string& key) {
  if (corners.size() < 3 || corners.size() > kMostCorners) reject("F0603", key, "has not 3 to 64 corners");
  std::vector<geometry::Point> points;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (!corners[k].is_array() || corners[k].size() != 2) reject("F0603", item(key, k), "is no pair [x, y]");
    points.push_back(
        {coordinate(corners[k][0], item(item(key, k), 0)), coordinate(corners[k][1], item(item(key, k), 1))});
  }
  auto hull = geometry::ConvexPolygon::hull(points);
  if (!hull) reject("F0603", key, "has no area");
  if (hull->corners().size() != points.size()) {
    reject("F0603", key, "is not convex, or a corner lies on a side", "list the corners of the hull only");
  }
  return *std::move(hull);
}

std::uint32_t count_of(const json& value, const std::string& key) {
  constexpr std::uint64_t kMost = 1'000'000;
  const std::uint64_t count = value.is_number_unsigned() ? value.get<std::uint64_t>() : 0;
  if (count < 1 || count > kMost) reject("F0602", key, "is no whole number from 1 to 1,000,000");
  return static_cast<std::uint32_t>(count);
}

EnvelopePolygon polygon_of(const json& value, const std::string& key, bool last) {
  only(value, key, {"corners_m", "stay_ms", "overlap_ms", "left_into"});
  EnvelopePolygon polygon{.area = area_of(list(value, key, "corners_m"), key + ".corners_m"),
                          .stay = bounds_of(member(value, key, "stay_ms"), key + ".stay_ms", 0),
                          .overlap = {}};
  for (const char* of_next : {"overlap_ms", "left_into"}) {
    if (!last || !value.contains(of_next)) continue;
    reject("F0604", key + "." + of_next, "belongs to no next polygon", "leave it out in the last polygon");
  }
  if (!last) polygon.overlap = bounds_of(member(value, key, "overlap_ms"), key + ".overlap_ms", 0);
  if (value.contains("left_into")) polygon.left_into = count_of(value["left_into"], key + ".left_into");
  if (polygon.overlap.least > polygon.stay.most) {
    reject("F0604", key + ".overlap_ms", "is longer than the stay can be");
  }
  return polygon;
}

std::vector<EnvelopePolygon> polygons_of(const json& list, const std::string& key) {
  if (!list.is_array()) reject("F0602", key, "is no list");
  if (list.empty()) reject("F0602", key, "is empty");
  std::vector<EnvelopePolygon> polygons;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::string here = item(key, k);
    polygons.push_back(polygon_of(list[k], here, k + 1 == list.size()));
    if (k == 0) continue;
    const EnvelopePolygon& before = polygons[k - 1];
    if (!geometry::overlaps(before.area, polygons[k].area)) {
      reject("F0603", here, "does not overlap the polygon before it");
    }
    if (before.overlap.least > polygons[k].stay.most) {
      reject("F0604", here + ".stay_ms", "is shorter than the overlap with the polygon before it");
    }
  }
  return polygons;
}

TrajectoryEnvelope envelope_of(const json& value, const std::string& key) {
  only(value, key, {"name", "polygons"});
  TrajectoryEnvelope envelope{.vehicle = text_of(value, key, "name"), .polygons = {}};
  envelope.polygons = polygons_of(member(value, key, "polygons"), key + ".polygons");
  return envelope;
}

using Names = std::map<std::string, std::uint32_t>;

TimepointRef timepoint_of(const json& value, const std::string& key, const SchedulingProblem& problem,
                          const Names& names) {
  only(value, key, {"vehicle", "polygon", "side"});
  const std::string vehicle = text_of(value, key, "vehicle");
  const auto named = names.find(vehicle);
  if (named == names.end()) reject("F0605", key + ".vehicle", "no vehicle is called '" + vehicle + "'");
  const json& polygon = member(value, key, "polygon");
  const std::size_t polygons = problem.envelopes[named->second].polygons.size();
  if (!polygon.is_number_unsigned() || polygon.get<std::uint64_t>() >= polygons) {
    reject("F0605", key + ".polygon", "'" + vehicle + "' has polygons 0 to " + std::to_string(polygons - 1));
  }
  const std::string side = text_of(value, key, "side");
  if (side != "entry" && side != "exit") reject("F0602", key + ".side", "is neither 'entry' nor 'exit'");
  return {{named->second, polygon.get<std::uint32_t>()}, side == "entry" ? Side::Entry : Side::Exit};
}

TemporalConstraint constraint_of(const json& value, const std::string& key, const SchedulingProblem& problem,
                                 const Names& names) {
  only(value, key, {"name", "from", "to", "distance_ms"});
  TemporalConstraint constraint{.name = text_of(value, key, "name"), .from = {}, .to = {}, .distance = {}};
  if (value.contains("from")) constraint.from = timepoint_of(value["from"], key + ".from", problem, names);
  constraint.to = timepoint_of(member(value, key, "to"), key + ".to", problem, names);
  constraint.distance = bounds_of(member(value, key, "distance_ms"), key + ".distance_ms", -kHorizon_ms);
  return constraint;
}

SchedulingProblem problem_of(const json& root) {
  only(root, "", {"vehicles", "constraints"});
  SchedulingProblem problem;
  Names names;
  const json& vehicles = list(root, "", "vehicles");
  for (std::size_t v = 0; v < vehicles.size(); ++v) {
    problem.envelopes.push_back(envelope_of(vehicles[v], item("vehicles", v)));
    const std::string& name = problem.envelopes.back().vehicle;
    if (!names.emplace(name, static_cast<std::uint32_t>(v)).second) {
      reject("F0605", item("vehicles", v) + ".name", "another vehicle is called '" + name + "', too");
    }
  }
  if (!root.contains("constraints")) return problem;
  const json& constraints = list(root, "", "constraints");
  for (std::size_t c = 0; c < constraints.size(); ++c) {
    problem.constraints.push_back(constraint_of(constraints[c], item("constraints", c), problem, names));
  }
  return problem;
}

json to_json(const Bounds& bounds) {
  json pair = {bounds.least.count(), bounds.most.count()};
  if (bounds.most.count() >= kHorizon_ms) pair[1] = nullptr;
  return pair;
}

json to_json(const TimepointRef& t, const SchedulingProblem& problem) {
  return {{"vehicle", problem.envelopes[t.at.vehicle].vehicle},
          {"polygon", t.at.polygon},
          {"side", t.side == Side::Entry ? "entry" : "exit"}};
}

}  // namespace

tl::expected<std::vector<EnvelopePolygon>, KeyProblem> read_polygons(const json& polygons,
                                                                     const std::string& key) {
  try {
    return polygons_of(polygons, key);
  } catch (const Rejected& rejected) {
    return tl::unexpected<KeyProblem>(rejected);
  }
}

result::Result<SchedulingProblem> read_problem(std::string_view text, const std::string& file) {
  try {
    return problem_of(json::parse(text.begin(), text.end()));
  } catch (const json::parse_error& error) {
    return result::fail("F0601", place_of_byte(text, error.byte == 0 ? 0 : error.byte - 1, file),
                        "this is no JSON");
  } catch (const json::exception&) {
    return result::fail("F0601", {file, 0, 0}, "a number is too large for any computer");
  } catch (const Rejected& rejected) {
    return result::fail(rejected.code, place_of_key(text, rejected.key, file),
                        rejected.key + ": " + rejected.what, rejected.hint);
  }
}

std::string write_problem(const SchedulingProblem& problem) {
  json root = {{"vehicles", json::array()}, {"constraints", json::array()}};
  for (const TrajectoryEnvelope& envelope : problem.envelopes) {
    json polygons = json::array();
    for (const EnvelopePolygon& polygon : envelope.polygons) {
      json corners = json::array();
      for (const geometry::Point p : polygon.area.corners()) corners.push_back({p.x_m, p.y_m});
      polygons.push_back({{"corners_m", corners}, {"stay_ms", to_json(polygon.stay)}});
      if (polygons.size() < envelope.polygons.size())
        polygons.back()["overlap_ms"] = to_json(polygon.overlap);
      if (polygons.size() < envelope.polygons.size() && polygon.left_into > 1)
        polygons.back()["left_into"] = polygon.left_into;
    }
    root["vehicles"].push_back({{"name", envelope.vehicle}, {"polygons", polygons}});
  }
  for (const TemporalConstraint& constraint : problem.constraints) {
    json one = {{"name", constraint.name},
                {"to", to_json(constraint.to, problem)},
                {"distance_ms", to_json(constraint.distance)}};
    if (constraint.from) one["from"] = to_json(*constraint.from, problem);
    root["constraints"].push_back(one);
  }
  return root.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace stepwright::fleet
