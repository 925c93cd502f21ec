#include "hmi_web/protocol/plan_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "hmi_web/protocol/json_text.h"

namespace stepwright::protocol {
namespace {

using nlohmann::json;

// So many poses are left out at once at most: 2.5 m of a planned path.
constexpr std::size_t kLongestChord = 50;

struct Pose {
  double x;
  double y;
  double heading_deg;
};

json parsed(const std::string& document) {
  // Writing a value out again recurses, so that what is nested deeper than any plan is left out.
  constexpr int kMaxDepth = 16;
  const auto shallow = [](int depth, json::parse_event_t, json&) { return depth < kMaxDepth; };
  return json::parse(document, shallow, /*allow_exceptions=*/false);
}

// What is no pose is left out.
std::vector<Pose> poses_of(const json& list) {
  std::vector<Pose> poses;
  if (!list.is_array()) return poses;
  for (const json& one : list) {
    const bool numbers =
        one.is_array() && one.size() == 3 && one[0].is_number() && one[1].is_number() && one[2].is_number();
    if (numbers) poses.push_back({one[0].get<double>(), one[1].get<double>(), one[2].get<double>()});
  }
  return poses;
}

double distance_to_chord(const Pose& p, const Pose& from, const Pose& to) {
  const double dx = to.x - from.x;
  const double dy = to.y - from.y;
  const double length = std::hypot(dx, dy);
  if (length == 0) return std::hypot(p.x - from.x, p.y - from.y);
  const double along = ((p.x - from.x) * dx + (p.y - from.y) * dy) / length;
  // Beyond an end: where the vehicle turns back.
  if (along < 0 || along > length) return std::hypot(p.x - from.x, p.y - from.y);
  return std::abs((p.x - from.x) * dy - (p.y - from.y) * dx) / length;
}

bool is_straight(const std::vector<Pose>& poses, std::size_t from, std::size_t to) {
  for (std::size_t k = from + 1; k < to; ++k) {
    if (distance_to_chord(poses[k], poses[from], poses[to]) > kWayTolerance_m) return false;
  }
  return true;
}

json thinned(const json& list) {
  const std::vector<Pose> poses = poses_of(list);
  json kept = json::array();
  const auto keep = [&](const Pose& pose) {
    kept.push_back({number(pose.x), number(pose.y), std::round(pose.heading_deg * 10) / 10});
  };
  for (std::size_t at = 0; at < poses.size();) {
    keep(poses[at]);
    std::size_t next = at + 1;
    while (next + 1 < poses.size() && next - at < kLongestChord && is_straight(poses, at, next + 1)) ++next;
    at = next;
  }
  return kept;
}

// A member of an object, moved out of it; null if there is none.
json taken(json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) return nullptr;
  json value = std::move(*found);
  object.erase(found);
  return value;
}

json ways(json paths) {
  if (!paths.is_array()) return json::array();
  for (json& path : paths) {
    if (path.is_object()) path["poses_m_m_deg"] = thinned(path.value("poses_m_m_deg", json()));
  }
  return paths;
}

// Millimetres are finer than what is drawn, and half of the bytes.
void round_all(json& value) {
  if (value.is_number_float()) value = number(value.get<double>());
  if (value.is_structured()) std::for_each(value.begin(), value.end(), round_all);
}

// Only what is drawn: corners, and when each is entered and left at the earliest.
json areas(json vehicles) {
  if (!vehicles.is_array()) return json::array();
  for (json& vehicle : vehicles) {
    if (!vehicle.is_object() || !vehicle.contains("polygons") || !vehicle["polygons"].is_array()) continue;
    for (json& polygon : vehicle["polygons"]) {
      if (!polygon.is_object()) continue;
      if (polygon.contains("corners_m")) round_all(polygon["corners_m"]);
      for (const char* key : {"latest_ms", "stay_ms", "overlap_ms"}) polygon.erase(key);
    }
  }
  return vehicles;
}

std::string routes_message(json& fleet) {
  fleet.erase("conflicts");
  fleet.erase("precedences");
  json routes = {{"paths", ways(taken(fleet, "paths"))},
                 {"polygons", areas(taken(fleet, "polygons"))},
                 {"sections", taken(fleet, "sections")}};
  round_all(routes["sections"]);
  return text({{"type", "routes"}, {"routes", std::move(routes)}});
}

}  // namespace

std::optional<PlanParts> plan_parts(const std::string& document) {
  json plan = parsed(document);
  if (!plan.is_object()) return std::nullopt;
  PlanParts parts;
  if (const auto fleet = plan.find("fleet"); fleet != plan.end() && fleet->is_object()) {
    parts.routes = routes_message(*fleet);
  }
  parts.plan = text({{"type", "plan"}, {"document", std::move(plan)}});
  return parts;
}

}  // namespace stepwright::protocol
