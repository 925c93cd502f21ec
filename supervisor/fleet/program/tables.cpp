#include "supervisor/fleet/program/tables.h"

#include <fmt/format.h>

#include <cmath>

#include "supervisor/vehicle/data_tables.h"
#include "supervisor/vehicle/literals.h"

namespace stepwright::fleet {
namespace {

using vehicle::data_table;
using vehicle::member;

// Numbers of polygons are INT, places are counts of centimetres in 16 bits.
constexpr std::size_t kMostPolygons = 32'000;
constexpr std::size_t kMostSamples = 1'000'000;
constexpr double kFarthest_m = 320.0;

constexpr std::size_t kAreaBytes = 16;
constexpr std::size_t kPlaneBytes = 12;

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
  const std::vector<vehicle::PathSample> samples = path_table(mission, options);
  VehicleTables tables;
  tables.samples = samples.size();
  tables.polygons = mission.grown.visits.size();
  if (!samples.empty()) tables.path = vehicle::path_table(name, samples, "the way of " + mission.vehicle);
  std::string areas;
  std::string planes;
  for (std::size_t k = 0; k < tables.polygons; ++k) {
    const auto sides = mission.grown.envelope.polygons[k].area.half_planes();
    for (const geometry::HalfPlane& side : sides) {
      planes += (planes.empty() ? "" : ",\n") +
                fmt::format("({}, {}, {})", member("NormalX", side.normal.x_m),
                            member("NormalY", side.normal.y_m), member("Offset", side.offset_m));
    }
    areas += (k == 0 ? "" : ",\n") +
             fmt::format("(First := {}, Last := {}, {}, {})", tables.sides, tables.sides + sides.size() - 1,
                         member("Entry", mission.grown.visits[k].entry_m), member("Free", free_m[k]));
    tables.sides += sides.size();
  }
  tables.areas =
      data_table("areas_of", name, "MC_AREA", tables.polygons, areas, "the polygons of " + mission.vehicle);
  tables.planes = data_table("planes_of", name, "MC_HALF_PLANE", tables.sides, planes,
                             "the sides of the polygons of " + mission.vehicle);
  tables.bytes =
      vehicle::kPathSampleBytes * tables.samples + kAreaBytes * tables.polygons + kPlaneBytes * tables.sides;
  return tables;
}

}  // namespace stepwright::fleet
