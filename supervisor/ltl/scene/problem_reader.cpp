#include "supervisor/ltl/scene/problem_reader.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "supervisor/fleet/map/map_file.h"
#include "supervisor/ltl/scene/map_floor.h"

namespace stepwright::ltl {

namespace {

using geometry::Point;
using nlohmann::json;

constexpr double kFarthest_m = 1e6;
constexpr std::size_t kMostBytes = 64u << 20;

// Errors of one file, each with the member that it is about.
class Complaints {
 public:
  explicit Complaints(std::string file) : file_(std::move(file)) {}

  void add(const char* code, const std::string& key, const std::string& message, std::string hint = {}) {
    found.push_back({code, result::Severity::Error, {file_, 0, 0},
                     (key.empty() ? "" : key + ": ") + message, std::move(hint)});
  }
  const std::string& file() const { return file_; }

  result::Diagnostics found;

 private:
  std::string file_;
};

result::Location place_of(std::string_view text, std::size_t byte, const std::string& file) {
  const std::string_view before = text.substr(0, std::min(byte > 0 ? byte - 1 : 0, text.size()));
  const auto line = static_cast<std::uint32_t>(std::ranges::count(before, '\n')) + 1;
  const std::size_t start = before.rfind('\n');
  const std::size_t column = before.size() - (start == std::string_view::npos ? 0 : start + 1);
  return {file, line, static_cast<std::uint32_t>(column) + 1};
}

result::Result<json> parse(std::string_view text, const std::string& file) try {
  return json::parse(text);
} catch (const json::parse_error& error) {
  return result::fail("L0401", place_of(text, error.byte, file), "this is no JSON",
                      "a member or a bracket is missing, or one too many");
} catch (const json::exception& error) {
  return result::fail("L0401", {file, 0, 0}, std::string("this is no JSON: ") + error.what());
}

std::optional<double> number(const json& value, const std::string& key, double least, double most,
                             Complaints& wrong) {
  if (!value.is_number()) {
    wrong.add("L0402", key, "is no number");
    return std::nullopt;
  }
  const double read = value.get<double>();
  if (read >= least && read <= most) return read;
  wrong.add("L0403", key, "is out of range", "from " + std::to_string(least) + " to " + std::to_string(most));
  return std::nullopt;
}

bool object(const json& value, const std::string& key, std::initializer_list<const char*> names,
            Complaints& wrong) {
  if (!value.is_object()) {
    wrong.add("L0402", key, "is no object");
    return false;
  }
  for (const auto& [name, member] : value.items()) {
    const bool known = std::ranges::any_of(names, [&](const char* each) { return name == each; });
    if (!known) wrong.add("L0402", key.empty() ? name : key + "." + name, "is not known here");
  }
  return true;
}

std::vector<Point> read_ring(const json& rings, const std::string& key, Complaints& wrong) {
  if (!rings.is_array() || rings.empty()) {
    wrong.add("L0402", key, "has no ring");
    return {};
  }
  if (rings.size() > 1) wrong.add("L0402", key, "has holes", "give what is in a hole as a polygon of its own");
  const json& list = rings[0];
  std::vector<Point> ring;
  if (!list.is_array()) {
    wrong.add("L0402", key + "[0]", "is no list of points");
    return {};
  }
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::string at = key + "[0][" + std::to_string(k) + "]";
    if (!list[k].is_array() || list[k].size() < 2) {
      wrong.add("L0402", at, "is no point", "[x, y] in metres");
      return {};
    }
    const auto x = number(list[k][0], at + "[0]", -kFarthest_m, kFarthest_m, wrong);
    const auto y = number(list[k][1], at + "[1]", -kFarthest_m, kFarthest_m, wrong);
    if (!x || !y) return {};
    ring.push_back({*x, *y});
  }
  if (ring.size() < 4 || ring.front() != ring.back()) {
    wrong.add("L0404", key, "the polygon is open", "its last point is its first one (GeoJSON, RFC 7946)");
    return {};
  }
  ring.pop_back();
  return ring;
}

void read_feature(const json& feature, const std::string& key, Floor& floor, Complaints& wrong) {
  const auto fails = [&](const std::string& member) {
    wrong.add("L0402", key + "." + member, "is missing or of the wrong kind",
              R"(a feature has "properties" with "kind" and "name", and a Polygon as "geometry")");
  };
  if (!feature.is_object()) return fails("type");
  const json properties = feature.value("properties", json());
  const json shape = feature.value("geometry", json());
  if (!properties.is_object()) return fails("properties");
  if (!shape.is_object() || shape.value("type", json()) != "Polygon") return fails("geometry");
  const json kind = properties.value("kind", json());
  const json name = properties.value("name", json(""));
  if (!kind.is_string()) return fails("properties.kind");
  if (!name.is_string()) return fails("properties.name");
  Area area{name.get<std::string>(),
            read_ring(shape.value("coordinates", json()), key + ".geometry.coordinates", wrong),
            {wrong.file(), 0, 0}};
  if (area.ring.empty()) return;
  if (kind == "border") {
    if (!floor.border.ring.empty()) wrong.add("L0405", key, "is a second border");
    floor.border = std::move(area);
  } else if (kind == "obstacle") {
    floor.obstacles.push_back(std::move(area));
  } else if (kind == "proposition") {
    if (area.name.empty()) return fails("properties.name");
    for (const Area& other : floor.propositions)
      if (other.name == area.name) wrong.add("L0405", key, "the place '" + area.name + "' is there twice");
    floor.propositions.push_back(std::move(area));
  } else {
    wrong.add("L0402", key + ".properties.kind", "is none of border, obstacle, proposition");
  }
}

void read_features(const json& root, Floor& floor, bool needs_border, Complaints& wrong) {
  const json* features = root.is_object() && root.contains("features") ? &root["features"] : nullptr;
  if (features == nullptr || !features->is_array()) {
    wrong.add("L0402", "features", "is missing or no list", "a scene is a GeoJSON FeatureCollection");
    return;
  }
  for (std::size_t k = 0; k < features->size(); ++k)
    read_feature((*features)[k], "features[" + std::to_string(k) + "]", floor, wrong);
  if (needs_border && floor.border.ring.empty() && wrong.found.empty())
    wrong.add("L0402", "features", "there is no border", "one polygon of kind border around all others");
}

std::optional<std::string> read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (in.bad() || text.size() > kMostBytes) return std::nullopt;
  return text;
}

class ProblemReader {
 public:
  ProblemReader(const json& root, const std::filesystem::path& file)
      : root_(root), file_(file), wrong_(file.string()) {}

  result::Result<Problem> read() {
    if (object(root_, "", {"scene", "map", "train", "start", "task"}, wrong_)) {
      read_floor();
      read_train();
      read_start();
      read_task();
    }
    if (!wrong_.found.empty()) return tl::unexpected(std::move(wrong_.found));
    return std::move(problem_);
  }

 private:
  void read_floor() {
    const bool has_map = root_.contains("map");
    if (!has_map && !root_.contains("scene"))
      wrong_.add("L0402", "scene", "is missing", "the name of a GeoJSON file, or \"map\" with a map.yaml");
    if (has_map) {
      if (!root_["map"].is_string()) return wrong_.add("L0402", "map", "is no file name");
      auto map = fleet::read_map(file_.parent_path() / root_["map"].get<std::string>());
      if (!map) return take(std::move(map.error()));
      problem_.floor = floor_of(*map, root_["map"].get<std::string>());
    }
    if (!root_.contains("scene")) return;
    if (!root_["scene"].is_string()) return wrong_.add("L0402", "scene", "is no file name");
    const auto path = file_.parent_path() / root_["scene"].get<std::string>();
    const auto text = read_file(path);
    if (!text) return wrong_.add("L0401", "scene", "'" + path.string() + "' cannot be read, or is too large");
    auto scene = parse(*text, path.string());
    if (!scene) return take(std::move(scene.error()));
    Complaints inside(path.string());
    read_features(*scene, problem_.floor, !has_map, inside);
    take(std::move(inside.found));
  }

  void read_train() {
    if (!root_.contains("train")) return;
    const json& train = root_["train"];
    const std::pair<const char*, double*> figures[] = {
        {"hitch_m", &problem_.train.hitch_m},
        {"wheelbase_m", &problem_.train.wheelbase_m},
        {"length_m", &problem_.train.length_m},
        {"width_m", &problem_.train.width_m},
        {"spacing_m", &problem_.train.spacing_m},
        {"most_speed_m_s", &problem_.train.most_speed_m_s},
        {"most_lock_rad", &problem_.train.most_lock_rad},
        {"most_acceleration_m_s2", &problem_.train.most_acceleration_m_s2},
        {"most_lock_rate_rad_s", &problem_.train.most_lock_rate_rad_s},
    };
    if (!object(train, "train",
                {"trailers", "reading", "hitch_m", "wheelbase_m", "length_m", "width_m", "spacing_m",
                 "most_speed_m_s", "most_lock_rad", "most_acceleration_m_s2", "most_lock_rate_rad_s"},
                wrong_))
      return;
    for (const auto& [name, value] : figures) {
      if (!train.contains(name)) continue;
      if (const auto read = number(train[name], std::string("train.") + name, 0.0, 1000.0, wrong_)) *value = *read;
    }
    if (train.contains("trailers")) {
      if (const auto count = number(train["trailers"], "train.trailers", 0, kMostTrailers, wrong_)) {
        if (*count != std::floor(*count)) wrong_.add("L0402", "train.trailers", "is no whole number");
        problem_.train.trailers = static_cast<std::size_t>(*count);
      }
    }
    if (train.contains("reading")) {
      if (train["reading"] == "printed")
        problem_.train.reading = HitchReading::Printed;
      else if (train["reading"] != "pulled")
        wrong_.add("L0402", "train.reading", "is none of pulled, printed");
    }
    if (auto sound = validate(problem_.train); !sound) take(std::move(sound.error()));
  }

  void read_start() {
    if (!root_.contains("start")) return wrong_.add("L0402", "start", "is missing");
    const json& start = root_["start"];
    if (!object(start, "start", {"x_m", "y_m", "heading_rad"}, wrong_)) return;
    const auto member = [&](const char* name, double most, double& into) {
      if (!start.contains(name)) return wrong_.add("L0402", std::string("start.") + name, "is missing");
      if (const auto read = number(start[name], std::string("start.") + name, -most, most, wrong_)) into = *read;
    };
    member("x_m", kFarthest_m, problem_.start.x_m);
    member("y_m", kFarthest_m, problem_.start.y_m);
    member("heading_rad", 10.0, problem_.start.heading_rad);
  }

  void read_task() {
    if (!root_.contains("task") || !root_["task"].is_string())
      return wrong_.add("L0402", "task", "is missing or no text", "a formula over the scene's places");
    problem_.task = root_["task"].get<std::string>();
  }

  void take(result::Diagnostics&& more) {
    for (auto& each : more) wrong_.found.push_back(std::move(each));
  }

  const json& root_;
  const std::filesystem::path& file_;
  Complaints wrong_;
  Problem problem_;
};

}  // namespace

result::Result<Floor> read_scene(std::string_view text, const std::string& file) {
  auto root = parse(text, file);
  if (!root) return result::forward(root);
  Complaints wrong(file);
  Floor floor;
  read_features(*root, floor, true, wrong);
  if (!wrong.found.empty()) return tl::unexpected(std::move(wrong.found));
  return floor;
}

result::Result<Problem> read_planning_problem(std::string_view text, const std::filesystem::path& file) {
  auto root = parse(text, file.string());
  if (!root) return result::forward(root);
  return ProblemReader(*root, file).read();
}

}  // namespace stepwright::ltl
