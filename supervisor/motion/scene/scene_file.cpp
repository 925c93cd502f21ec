#include "supervisor/motion/scene/scene_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "runtime/ground/settings/toml_document.h"
#include "supervisor/motion/mesh/mesh_reader.h"
#include "supervisor/motion/recheck/overlap.h"

namespace stepwright::motion {

namespace {

using settings::TomlDocument;
using settings::TomlTable;

class SceneTables {
 public:
  SceneTables(const TomlTable& root, const std::filesystem::path& folder) : root_(root), folder_(folder) {}

  const result::Diagnostics& wrong() const { return wrong_; }  // of files that this one names

  SceneFile read() {
    for (const TomlTable& table : root_.tables("box")) read_box(table);
    for (const TomlTable& table : root_.tables("cylinder")) read_cylinder(table);
    for (const TomlTable& table : root_.tables("sphere")) read_sphere(table);
    for (const TomlTable& table : root_.tables("mesh")) read_mesh_file(table);
    for (const TomlTable& table : root_.tables("allowed")) {
      world_.allowed.emplace_back(table.required_text("link"), table.required_text("thing"));
      allowed_at_.push_back(table.where());
    }
    return {std::move(world_), std::move(places_), std::move(allowed_at_), {}};
  }

 private:
  void add(const TomlTable& table, Obstacle obstacle) {
    if (world_.obstacles.size() == kMostThings) {
      table.report("", "there are more than 4096 things");
    } else if (world_.obstacles.size() < kMostThings) {
      for (const Obstacle& other : world_.obstacles)
        if (other.name == obstacle.name && other.shape.kind == obstacle.shape.kind &&
            other.shape.origin == obstacle.shape.origin && other.shape.size_m == obstacle.shape.size_m &&
            other.shape.radius_m == obstacle.shape.radius_m && other.shape.mesh == obstacle.shape.mesh)
          table.report("name", "'" + obstacle.name + "' stands there twice",
                       "parts of one thing may share its name, but not their place", scene_code::kTwice);
      world_.obstacles.push_back(std::move(obstacle));
      places_.push_back(table.where());
    }
  }

  // As many numbers as `count`; what is missing or beyond `most` is told.
  std::optional<std::vector<double>> numbers(const TomlTable& table, const char* key, std::size_t count,
                                             double most) const {
    std::vector<double> values = table.numbers(key);
    if (!table.has(key)) {
      table.report("", "'" + std::string(key) + "' is missing", "", "0005");
      return std::nullopt;
    }
    if (values.size() != count) {
      table.report(key, "'" + std::string(key) + "' is no list of " + std::to_string(count) + " numbers");
      return std::nullopt;
    }
    for (const double each : values) {
      if (std::abs(each) <= most) continue;
      if (std::isfinite(each) && most == kFarthest_m)
        table.report(key, "'" + std::string(key) + "' is " + text_of(each) + " m, further than 50 m",
                     "millimetres were taken for metres? lengths are in metres", scene_code::kUnits);
      else
        table.report(key, "'" + std::string(key) + "' is out of range", "", "0004");
      return std::nullopt;
    }
    return values;
  }

  static std::string text_of(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
  }

  // A length that is above zero.
  double size(const TomlTable& table, const char* key) const {
    const double value = table.required_number(key);
    if (!table.has(key)) return 1.0;
    if (!(value > 0.0)) table.report(key, "'" + std::string(key) + "' is not above zero", "", "0004");
    if (value > kFarthest_m)
      table.report(key, "'" + std::string(key) + "' is " + text_of(value) + " m, larger than 50 m",
                   "millimetres were taken for metres? lengths are in metres", scene_code::kUnits);
    return value > 0.0 && value <= kFarthest_m ? value : 1.0;
  }

  Rotation turn(const TomlTable& table) const {
    constexpr double kDegree = std::numbers::pi / 180.0;
    if (table.has("turn_deg") && table.has("quaternion")) {
      table.report("quaternion", "a turn is said twice", "turn_deg or quaternion", scene_code::kNoTurn);
      (void)table.numbers("turn_deg");
      (void)table.numbers("quaternion");
      return {};
    }
    if (table.has("quaternion")) {
      const auto q = numbers(table, "quaternion", 4, 2.0);
      if (!q) return {};
      const double square = (*q)[0] * (*q)[0] + (*q)[1] * (*q)[1] + (*q)[2] * (*q)[2] + (*q)[3] * (*q)[3];
      constexpr double kRounded = 0.02;
      if (std::abs(square - 1.0) <= kRounded) return from_quaternion((*q)[3], (*q)[0], (*q)[1], (*q)[2]);
      table.report("quaternion", "the quaternion is not of length 1", "x, y, z, w", scene_code::kNoTurn);
      return {};
    }
    if (!table.has("turn_deg")) return {};
    const auto angles = numbers(table, "turn_deg", 3, 360.0);
    if (!angles) return {};
    return from_rpy(kDegree * (*angles)[0], kDegree * (*angles)[1], kDegree * (*angles)[2]);
  }

  Transform place(const TomlTable& table) const {
    const auto at = numbers(table, "at_m", 3, kFarthest_m);
    return {turn(table), at ? Vector3{(*at)[0], (*at)[1], (*at)[2]} : Vector3{}};
  }

  void read_box(const TomlTable& table) {
    const std::string name = table.required_text("name");
    const Transform at = place(table);
    const auto sizes = numbers(table, "size_m", 3, kFarthest_m);
    if (!sizes) return;
    if (!(*std::min_element(sizes->begin(), sizes->end()) > 0.0))
      table.report("size_m", "'size_m' is not above zero", "", "0004");
    else
      add(table, box(name, at, {(*sizes)[0], (*sizes)[1], (*sizes)[2]}));
  }

  void read_cylinder(const TomlTable& table) {
    const std::string name = table.required_text("name");
    const Transform at = place(table);
    const double radius_m = size(table, "radius_m"), length_m = size(table, "length_m");
    add(table, cylinder(name, at, radius_m, length_m));
  }

  void read_sphere(const TomlTable& table) {
    const std::string name = table.required_text("name");
    const auto at = numbers(table, "at_m", 3, kFarthest_m);
    const double radius_m = size(table, "radius_m");
    if (at) add(table, sphere(name, {(*at)[0], (*at)[1], (*at)[2]}, radius_m));
  }

  void read_mesh_file(const TomlTable& table) {
    const std::string name = table.required_text("name"), file = table.required_text("file");
    const Transform at = place(table);
    const double scale = table.number("scale", 1.0, {1e-6, 1e6});
    const double protrusion_m = table.number("protrusion_m", kObstacleCover.protrusion_m, {1e-3, 1.0});
    if (file.empty()) return;
    auto triangles = read_mesh(folder_ / file, {scale, scale, scale});
    if (!triangles) {
      for (result::Diagnostic each : triangles.error()) {
        each.where = table.where("file");
        each.message = "'" + file + "': " + each.message;
        wrong_.push_back(std::move(each));
      }
      return;
    }
    double far_m = 0.0;
    for (const Vector3& each : triangles->points) far_m = std::max(far_m, length(each));
    constexpr double kSmallest_m = 1e-3;
    if (far_m > kFarthest_m || far_m < kSmallest_m) {
      table.report("file", "'" + name + "' reaches " + text_of(far_m) + " m from its origin",
                   far_m > kFarthest_m ? "its file is in millimetres? scale = 0.001" : "scale = 1000?",
                   scene_code::kUnits);
      return;
    }
    Obstacle obstacle = mesh(name, at, std::make_shared<const TriangleMesh>(std::move(*triangles)),
                             {.protrusion_m = protrusion_m, .most_per_body = kObstacleCover.most_per_body});
    obstacle.shape.mesh = file;
    add(table, std::move(obstacle));
  }

  const TomlTable& root_;
  const std::filesystem::path& folder_;
  World world_;
  std::vector<result::Location> places_, allowed_at_;
  result::Diagnostics wrong_;
};

result::Result<SceneFile> read_document(TomlDocument& document, const std::filesystem::path& folder) {
  const TomlTable root = document.root();
  SceneTables tables(root, folder);
  SceneFile scene = tables.read();
  result::Diagnostics problems = document.finish();
  problems.insert(problems.end(), tables.wrong().begin(), tables.wrong().end());
  if (result::has_errors(problems)) return tl::unexpected(std::move(problems));
  scene.warnings = std::move(problems);
  const result::Diagnostics both = overlaps(scene.world, scene.places);
  scene.warnings.insert(scene.warnings.end(), both.begin(), both.end());
  return scene;
}

}  // namespace

result::Result<SceneFile> load_scene(const std::filesystem::path& file) {
  auto document = TomlDocument::load(file, "A");
  if (!document) return result::forward(document);
  return read_document(**document, file.parent_path());
}

result::Result<SceneFile> read_scene(std::string_view text, std::string name,
                                     const std::filesystem::path& folder) {
  auto document = TomlDocument::parse(text, name, "A");
  if (!document) return result::forward(document);
  return read_document(**document, folder);
}

result::Diagnostics overlaps(const World& world, const std::vector<result::Location>& places,
                             double deeper_than_m, std::size_t most) {
  result::Diagnostics warnings;
  const auto pairs = overlapping(world, deeper_than_m);
  for (std::size_t k = 0; k < std::min(most, pairs.size()); ++k) {
    const auto& [a, b] = pairs[k];
    warnings.push_back(
        {scene_code::kOverlap,
         result::Severity::Warning,
         places[std::max(a, b)],
         "'" + world.obstacles[a].name + "' and '" + world.obstacles[b].name + "' stand in each other",
         {}});
  }
  if (pairs.size() > most)
    warnings.push_back({scene_code::kOverlap,
                        result::Severity::Warning,
                        {places.front().file},
                        "and " + std::to_string(pairs.size() - most) + " more pairs",
                        {}});
  return warnings;
}

}  // namespace stepwright::motion
