#include "supervisor/fleet/program/tables.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include "supervisor/fleet/program/mission_chart.h"

namespace stepwright::fleet {
namespace {

// Numbers of polygons are INT, places are counts of centimetres in 16 bits.
constexpr std::size_t kMostPolygons = 32'000;
constexpr std::size_t kMostSamples = 1'000'000;
constexpr double kFarthest_m = 320.0;

constexpr std::size_t kSampleBytes = 40;
constexpr std::size_t kAreaBytes = 16;
constexpr std::size_t kPlaneBytes = 12;

// FNV-1a, 32 bits.
std::string digest(std::string_view text) {
  std::uint32_t hash = 2166136261U;
  for (const char c : text) hash = (hash ^ static_cast<std::uint8_t>(c)) * 16777619U;
  return fmt::format("{:08x}", hash);
}

graphic::Variable table(const std::string& what, const std::string& name, const char* type, std::size_t count,
                        std::string rows, std::string comment) {
  graphic::Variable made;
  made.type = fmt::format("ARRAY[0..{}] OF {}", count - 1, type);
  made.section = graphic::VariableSection::Global;
  made.initial = "[" + std::move(rows) + "]";
  made.name = fmt::format("{}_{}_{}", what, name, digest(made.initial));
  made.comment = std::move(comment);
  return made;
}

std::string field(const char* name, double value) {
  return fmt::format("{} := {}", name, real_literal(value));
}

std::string row(const PathSample& s) {
  return fmt::format("({}, {}, {}, {}, {}, {}, {}, {}, {}, {})", field("X", s.pose.x_m),
                     field("Y", s.pose.y_m), field("Heading", s.pose.heading_rad),
                     field("Curvature", s.curvature_1_m), field("Arc", s.arc_m), field("Speed", s.speed_m_s),
                     field("Rest", s.rest_m), field("Left", s.left_m), field("Right", s.right_m),
                     field("Way", s.way));
}

result::Result<void> check_size(const VehicleMission& mission, std::size_t samples) {
  const auto too_large = [&](const std::string& what, const char* hint) {
    return result::fail("F1104", {}, fmt::format("vehicle '{}': {}", mission.vehicle, what), hint);
  };
  const std::size_t polygons = mission.grown.visits.size();
  if (polygons > kMostPolygons) {
    return too_large(fmt::format("{} polygons, more than {}", polygons, kMostPolygons),
                     "plan a shorter mission; numbers of polygons are INT");
  }
  if (samples > kMostSamples) {
    return too_large(fmt::format("{} samples of its path, more than {}", samples, kMostSamples),
                     "plan a shorter mission, or take a larger sample_m");
  }
  for (std::size_t k = 0; k < mission.path.size(); ++k) {
    const auto& [pose, arc_m, travel] = mission.path[k];
    const bool finite = std::isfinite(pose.x_m) && std::isfinite(pose.y_m) &&
                        std::isfinite(pose.heading_rad) && std::isfinite(arc_m);
    if (!finite || std::abs(pose.x_m) > kFarthest_m || std::abs(pose.y_m) > kFarthest_m) {
      return too_large(
          fmt::format("pose {} of its path is not within 320 m of the origin", k),
          "navigation counts centimetres in 16 bits: move the origin into the middle of the map");
    }
  }
  return {};
}

}  // namespace

result::Result<VehicleTables> vehicle_tables(const VehicleMission& mission, const std::string& name,
                                             const std::vector<double>& free_m,
                                             const ProgramOptions& options) {
  if (auto good = check_size(mission, mission.path.size()); !good) return result::forward(good);
  const std::vector<PathSample> samples = path_table(mission, options);
  VehicleTables tables;
  tables.samples = samples.size();
  tables.polygons = mission.grown.visits.size();
  std::string rows;
  for (const PathSample& sample : samples) rows += (rows.empty() ? "" : ",\n") + row(sample);
  if (!samples.empty()) {
    tables.path = table("path", name, "MC_PATH_POINT", samples.size(), std::move(rows),
                        "the way of " + mission.vehicle);
  }
  std::string areas;
  std::string planes;
  for (std::size_t k = 0; k < tables.polygons; ++k) {
    const auto sides = mission.grown.envelope.polygons[k].area.half_planes();
    for (const geometry::HalfPlane& side : sides) {
      planes += (planes.empty() ? "" : ",\n") + fmt::format("({}, {}, {})", field("NormalX", side.normal.x_m),
                                                            field("NormalY", side.normal.y_m),
                                                            field("Offset", side.offset_m));
    }
    areas += (k == 0 ? "" : ",\n") +
             fmt::format("(First := {}, Last := {}, {}, {})", tables.sides, tables.sides + sides.size() - 1,
                         field("Entry", mission.grown.visits[k].entry_m), field("Free", free_m[k]));
    tables.sides += sides.size();
  }
  tables.areas = table("areas_of", name, "MC_AREA", tables.polygons, std::move(areas),
                       "the polygons of " + mission.vehicle);
  tables.planes = table("planes_of", name, "MC_HALF_PLANE", tables.sides, std::move(planes),
                        "the sides of the polygons of " + mission.vehicle);
  tables.bytes = kSampleBytes * tables.samples + kAreaBytes * tables.polygons + kPlaneBytes * tables.sides;
  return tables;
}

}  // namespace stepwright::fleet
