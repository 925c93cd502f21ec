#include "cell/missions/tamp/check_cell.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace stepwright::missions {
namespace {

constexpr double kSame_m = 0.0015;

// Diameter and height of the plant's kinds (plant_models/doc/robot_cell.md).
const std::map<std::string, std::pair<double, double>>& usual() {
  static const std::map<std::string, std::pair<double, double>> sizes = {{"cup", {0.07, 0.1}},
                                                                         {"can", {0.066, 0.115}}};
  return sizes;
}

class Check {
 public:
  Check(const config::RobotCellPlantConfig& plant, const tamp::scene::RobotCell& cell,
        const result::Location& problem)
      : plant_(plant), cell_(cell), problem_(problem) {}

  result::Diagnostics run() {
    for (std::size_t k = 0; k < cell_.arms.size(); ++k)
      if (k >= plant_.arms.size() || plant_.arms[k].name != cell_.arms[k].name)
        say(k < plant_.arms.size() ? plant_.arms[k].where : problem_,
            fmt::format("arm {} is '{}' in the problem", k + 1, cell_.arms[k].name));
    for (const auto& each : cell_.furniture) {
      const auto same = std::ranges::find(plant_.fixed, each.name, &config::FixedBodyConfig::name);
      if (same == plant_.fixed.end())
        say(problem_, "the simulated cell has no '" + each.name + "'");
      else
        furniture(each, *same);
    }
    for (const auto& each : plant_.blockages)
      if (0.5 * std::hypot(each.length_m, each.width_m) > radius_around(cell_.obstacle) + kSame_m ||
          each.height_m > cell_.obstacle.height_m + kSame_m)
        say(each.place.where, "'" + each.name + "' is larger than the [obstacle] of the problem");
    for (const auto& each : cell_.things) {
      const auto same = std::ranges::find(plant_.objects, each.name, &config::CellObjectConfig::name);
      if (same == plant_.objects.end())
        say(problem_, "the simulated cell has no '" + each.name + "'");
      else
        thing(each, *same);
    }
    return std::move(wrong_);
  }

 private:
  void say(const result::Location& where, std::string what) {
    wrong_.push_back({"G0403", result::Severity::Error, where, std::move(what),
                      "[plant] and the problem describe one cell: the same names, sizes and places"});
  }

  void furniture(const tamp::scene::Furniture& planned, const config::FixedBodyConfig& there) {
    const double top_m = planned.pose.z_m + planned.form.height_m,
                 top_there_m = there.z_m + 0.5 * there.height_m;
    const bool same = std::abs(planned.pose.x_m - there.place.x_m) < kSame_m &&
                      std::abs(planned.pose.y_m - there.place.y_m) < kSame_m &&
                      std::abs(top_m - top_there_m) < kSame_m &&
                      (planned.form.round || (std::abs(planned.form.size_x_m - there.length_m) < kSame_m &&
                                              std::abs(planned.form.size_y_m - there.width_m) < kSame_m));
    if (!same) say(there.place.where, "'" + planned.name + "' is another one in the problem");
  }

  void thing(const tamp::scene::Thing& planned, const config::CellObjectConfig& there) {
    if (planned.kind != there.kind)
      say(there.place.where, "'" + planned.name + "' is of kind '" + planned.kind + "' in the problem");
    const auto size = usual().find(there.kind);
    if (size == usual().end()) return;
    const double across_m = there.length_m > 0.0 ? there.length_m : size->second.first;
    const double height_m = there.height_m > 0.0 ? there.height_m : size->second.second;
    if (std::abs(2.0 * planned.form.radius_m - across_m) > kSame_m ||
        std::abs(planned.form.height_m - height_m) > kSame_m)
      say(there.place.where, "'" + planned.name + "' has another size in the problem");
  }

  const config::RobotCellPlantConfig& plant_;
  const tamp::scene::RobotCell& cell_;
  const result::Location& problem_;
  result::Diagnostics wrong_;
};

}  // namespace

result::Result<void> check_agrees(const config::PlantConfig& plant, const tamp::scene::RobotCell& cell,
                                  const result::Location& problem) {
  if (plant.kind != "robot_cell") return {};
  result::Diagnostics wrong = Check(plant.robot_cell, cell, problem).run();
  if (!wrong.empty()) return tl::unexpected(std::move(wrong));
  return {};
}

}  // namespace stepwright::missions
