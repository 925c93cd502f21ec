#include "supervisor/ltl/scene/scene_reader.h"

#include <utility>

#include "supervisor/ltl/scene/internal/json_text.h"

namespace stepwright::ltl {

namespace {

using geometry::Point;
using internal::Complaints;
using internal::kFarthest_m;
using internal::member;
using internal::number;
using nlohmann::json;

// Nothing where it is wrong.
std::vector<Point> read_points(const json& list, const std::string& key, Complaints& wrong) {
  std::vector<Point> points;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::string at = key + "[" + std::to_string(k) + "]";
    if (!list[k].is_array() || list[k].size() < 2) {
      wrong.add("L0402", at, "is no point", "[x, y] in metres");
      return {};
    }
    const auto x = number(list[k][0], at + "[0]", -kFarthest_m, kFarthest_m, wrong);
    const auto y = number(list[k][1], at + "[1]", -kFarthest_m, kFarthest_m, wrong);
    if (!x || !y) return {};
    points.push_back({*x, *y});
  }
  return points;
}

std::vector<Point> read_ring(const json& rings, const std::string& key, Complaints& wrong) {
  if (!rings.is_array() || rings.empty()) {
    wrong.add("L0402", key, "has no ring");
    return {};
  }
  if (rings.size() > 1)
    wrong.add("L0402", key, "has holes", "give what is in a hole as a polygon of its own");
  if (!rings[0].is_array()) {
    wrong.add("L0402", key + "[0]", "is no list of points");
    return {};
  }
  const std::size_t errors = wrong.found.size();
  std::vector<Point> ring = read_points(rings[0], key + "[0]", wrong);
  if (wrong.found.size() > errors) return {};
  if (ring.empty() || ring.front() != ring.back()) {
    wrong.add("L0404", key, "the polygon is open", "its last point is its first one (GeoJSON, RFC 7946)");
    return {};
  }
  ring.pop_back();
  if (ring.size() >= 3) return ring;
  wrong.add("L0201", key, "the polygon has fewer than three points");
  return {};
}

void add_area(const std::string& kind, Area area, const std::string& key, Floor& floor, Complaints& wrong) {
  if (kind == "border") {
    if (!floor.border.ring.empty()) return wrong.add("L0405", key, "is a second border");
    floor.border = std::move(area);
  } else if (kind == "obstacle") {
    floor.obstacles.push_back(std::move(area));
  } else if (kind == "proposition") {
    if (area.name.empty()) return wrong.add("L0402", key + ".properties.name", "is missing");
    for (const Area& other : floor.propositions)
      if (other.name == area.name) wrong.add("L0405", key, "the place '" + area.name + "' is there twice");
    floor.propositions.push_back(std::move(area));
  } else {
    wrong.add("L0402", key + ".properties.kind", "is none of border, obstacle, proposition");
  }
}

// "Feature" and its like; a value of another type says what the file is instead.
bool is_type(const json& value, const std::string& key, const char* type, Complaints& wrong) {
  const json& said = member(value, "type");
  if (said.is_string() && said.get_ref<const std::string&>() == type) return true;
  wrong.add("L0402", key, std::string("is missing or not \"") + type + "\"",
            "a scene is a GeoJSON FeatureCollection of Features (RFC 7946)");
  return false;
}

void read_feature(const json& feature, const std::string& key, Floor& floor, Complaints& wrong) {
  if (!is_type(feature, key + ".type", "Feature", wrong)) return;
  const auto fails = [&](const std::string& name) {
    wrong.add("L0402", key + "." + name, "is missing or of the wrong kind",
              R"(a feature has "properties" with "kind" and "name", and a Polygon as "geometry")");
  };
  const json& properties = member(feature, "properties");
  const json& shape = member(feature, "geometry");
  const json& kind = member(properties, "kind");
  const json& name = member(properties, "name");
  const json& type = member(shape, "type");
  if (!kind.is_string()) return fails("properties.kind");
  if (!name.is_string() && !name.is_null()) return fails("properties.name");
  if (!type.is_string() || type.get<std::string>() != "Polygon") return fails("geometry");
  Area area{name.is_string() ? name.get<std::string>() : std::string(),
            read_ring(member(shape, "coordinates"), key + ".geometry.coordinates", wrong),
            {wrong.file(), 0, 0}};
  if (!area.ring.empty()) add_area(kind.get<std::string>(), std::move(area), key, floor, wrong);
}

}  // namespace

result::Result<Floor> read_scene(std::string_view text, const std::string& file, Floor into, Border border) {
  auto root = internal::parse(text, file);
  if (!root) return result::forward(root);
  Complaints wrong(file);
  const json& features = member(*root, "features");
  if (root->is_object()) (void)is_type(*root, "type", "FeatureCollection", wrong);
  if (!features.is_array())
    wrong.add("L0402", "features", "is missing or no list", "a scene is a GeoJSON FeatureCollection");
  else
    for (std::size_t k = 0; k < features.size(); ++k)
      read_feature(features[k], "features[" + std::to_string(k) + "]", into, wrong);
  if (border == Border::InTheScene && into.border.ring.empty() && wrong.found.empty())
    wrong.add("L0402", "features", "there is no border", "one polygon of kind border around all others");
  if (!wrong.found.empty()) return tl::unexpected(std::move(wrong.found));
  return into;
}

}  // namespace stepwright::ltl
