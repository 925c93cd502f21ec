#include "supervisor/tamp/intervals/file/sequence_file.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "runtime/ground/result/closest.h"
#include "runtime/ground/settings/toml_document.h"
#include "supervisor/motion/robot/urdf_reader.h"
#include "supervisor/tamp/intervals/arm/srs_exact.h"
#include "supervisor/tamp/intervals/arm/srs_reach.h"
#include "supervisor/tamp/intervals/reach/column_arm.h"

namespace stepwright::tamp {
namespace {

using settings::Range;
using settings::TomlTable;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr Range kCoordinate{-9.0, 9.0}, kTurns{-360.0, 360.0}, kLength{0.0, 5.0};
// A table of more cells than this takes longer to make than people wait.
constexpr double kMostCells = 4e6;
constexpr std::size_t kMostActions = 200;
constexpr std::size_t kMostBytes = 8u << 20;  // of a URDF

class SequenceReader {
 public:
  SequenceReader(const TomlTable& root, std::filesystem::path folder)
      : root_(root), folder_(std::move(folder)) {}

  // Of files that this one names.
  const result::Diagnostics& wrong() const { return wrong_; }
  const std::vector<result::Location>& actions_at() const { return actions_at_; }

  SequenceFile read() {
    for (const TomlTable& table : root_.tables("arm")) read_arm(table);
    for (const TomlTable& table : root_.tables("grasp")) read_grasp(table);
    for (const TomlTable& table : root_.tables("region")) read_region(table);
    for (const TomlTable& table : root_.tables("object")) read_object(table);
    const std::vector<TomlTable> actions = root_.tables("action");
    if (actions.size() > kMostActions) actions[kMostActions].report("", "there are more than 200 actions");
    for (std::size_t k = 0; k < std::min(actions.size(), kMostActions); ++k) read_action(actions[k]);
    return std::move(file_);
  }

 private:
  std::string new_name(const TomlTable& table, std::vector<std::string>& names) {
    const std::string name = table.required_text("name");
    if (std::ranges::find(names, name) != names.end())
      table.report("name", "'" + name + "' is used twice",
                   "names tell arms, grasps, regions and objects apart", "0104");
    names.push_back(name);
    return name;
  }

  void read_arm(const TomlTable& table) {
    const std::string name = new_name(table, arms_);
    file_.shoulders.emplace_back();
    file_.exacts.emplace_back();
    std::optional<ReachTable> reach = table.has("urdf") ? urdf_reach(table) : column_reach(table);
    // Whatever is wrong with it has been said; the rest of the file is read.
    if (!reach) reach = reach_table({}, 0.5);
    file_.reaches.push_back(std::make_unique<const ReachTable>(*std::move(reach)));
    file_.cell.arms.push_back({name, file_.reaches.back().get(), file_.exacts.back().get()});
  }

  // The width of cells, if there are not too many of them.
  std::optional<double> cell_width(const TomlTable& table, double most_m) {
    const double cell_m = table.number("cell_m", 0.04, {0.005, 1.0});
    const double across = 2.0 * most_m / cell_m + 3.0;
    if (across * across * across <= kMostCells) return cell_m;
    table.report("cell_m", "its table of reach has too many cells", "larger cells, or a shorter arm");
    return std::nullopt;
  }

  std::optional<ReachTable> column_reach(const TomlTable& table) {
    ColumnArm arm;
    arm.x_m = table.number("x_m", 0.0, kCoordinate);
    arm.y_m = table.number("y_m", 0.0, kCoordinate);
    arm.z_m = table.number("z_m", 0.0, kCoordinate);
    arm.least_m = table.number("least_m", arm.least_m, kLength);
    arm.easy_m = table.number("easy_m", arm.easy_m, kLength);
    arm.most_m = table.number("most_m", arm.most_m, {0.01, 5.0});
    arm.lean_rad = kDegree * table.number("lean_deg", 0.0, kTurns);
    arm.turn_rad = kDegree * table.number("turn_deg", 90.0, {0.0, 360.0});
    arm.flip_rad = kDegree * table.number("flip_deg", 0.0, {0.0, 360.0});
    const auto cell_m = cell_width(table, arm.most_m);
    if (arm.least_m > arm.easy_m || arm.easy_m >= arm.most_m) {
      table.report("most_m", "least_m, easy_m and most_m do not ascend");
      return std::nullopt;
    }
    if (!cell_m) return std::nullopt;
    file_.shoulders.back() = {{arm.x_m, arm.y_m, arm.z_m}, 0.0};
    file_.exacts.back() = std::make_unique<const ColumnReach>(arm);
    return reach_table(arm, *cell_m);
  }

  std::optional<ReachTable> urdf_reach(const TomlTable& table) {
    const std::string name = table.required_text("urdf"), base = table.required_text("base"),
                      tip = table.required_text("tip");
    const Point3 at{nanometres_of(table.number("x_m", 0.0, kCoordinate)),
                    nanometres_of(table.number("y_m", 0.0, kCoordinate)),
                    nanometres_of(table.number("z_m", 0.0, kCoordinate))};
    const auto path = (folder_ / name).string();
    std::ifstream in(path, std::ios::binary);
    std::string text(kMostBytes + 1, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    if (text.empty() || text.size() > kMostBytes) {
      table.report("urdf", "'" + path + "' cannot be read, is empty or too large");
      return std::nullopt;
    }
    const auto robot = motion::read_urdf(text, path);
    if (!robot) return take(robot.error());
    const auto chain =
        motion::Chain::between(*robot, link(table, *robot, "base", base), link(table, *robot, "tip", tip));
    if (!chain) return take(chain.error());
    const auto reach = SrsReach::make(*chain);
    if (!reach) {
      table.report(
          "tip", "no bounds are made of this arm",
          "seven joints, the first three and the last three of which meet; the tip's z axis is the last one",
          "0105");
      return std::nullopt;
    }
    const auto cell_m = cell_width(table, reach->most_m());
    if (!cell_m) return std::nullopt;
    Shoulder& shoulder = file_.shoulders.back() = reach->shoulder();
    for (std::size_t axis = 0; axis < 3; ++axis) shoulder.at_m[axis] += metres_of(at[axis]);
    if (auto exact = SrsExact::make(*chain, at))
      file_.exacts.back() = std::make_unique<const SrsExact>(*std::move(exact));
    return reach->table(*cell_m, at);
  }

  static int link(const TomlTable& table, const motion::Robot& robot, const char* key,
                  const std::string& name) {
    const int found = robot.link(name);
    if (found < 0 && !name.empty()) table.report(key, "the robot has no link '" + name + "'", "", "0103");
    return std::max(found, 0);
  }

  std::optional<ReachTable> take(const result::Diagnostics& wrong) {
    wrong_.insert(wrong_.end(), wrong.begin(), wrong.end());
    return std::nullopt;
  }

  void read_grasp(const TomlTable& table) {
    Grasp grasp;
    grasp.name = new_name(table, grasps_);
    grasp.height_m = table.required_number("height_m", {-2.0, 2.0});
    grasp.radius_m = table.number("radius_m", 0.0, {0.0, 1.0});
    for (const std::vector<double>& range : table.number_rows("angles_deg", 2)) {
      if (!(range[0] <= range[1] && range[0] >= -360.0 && range[1] <= 720.0))
        table.report("angles_deg", "a range is [from, to] in degrees, anticlockwise, from -360 to 720");
      else
        grasp.angles.push_back({kDegree * range[0], kDegree * range[1]});
    }
    file_.cell.grasps.push_back(std::move(grasp));
  }

  void read_region(const TomlTable& table) {
    Region region;
    region.name = new_name(table, places_);
    region.x_m = table.required_number("x_m", kCoordinate);
    region.y_m = table.required_number("y_m", kCoordinate);
    region.z_m = table.required_number("z_m", kCoordinate);
    region.size_x_m = table.required_number("size_x_m", kLength);
    region.size_y_m = table.required_number("size_y_m", kLength);
    region.heading_rad = kDegree * table.number("heading_deg", 0.0, kTurns);
    regions_.push_back(region.name);
    file_.cell.regions.push_back(std::move(region));
  }

  void read_object(const TomlTable& table) {
    Object object;
    object.name = new_name(table, places_);
    object.start.x_m = table.required_number("x_m", kCoordinate);
    object.start.y_m = table.required_number("y_m", kCoordinate);
    object.start.z_m = table.required_number("z_m", kCoordinate);
    object.start.angle_rad = kDegree * table.number("angle_deg", 0.0, kTurns);
    object.height_m = table.number("height_m", 0.1, {0.0, 2.0});
    objects_.push_back(object.name);
    file_.cell.objects.push_back(std::move(object));
  }

  static std::size_t index_of(const std::vector<std::string>& names, const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  }

  // Beyond the end, and reported, if there is no such name.
  std::size_t named(const TomlTable& table, const char* key, const std::vector<std::string>& names) {
    const std::string name = table.required_text(key);
    const std::size_t at = index_of(names, name);
    if (at < names.size() || name.empty()) return at;
    const std::string* meant = result::closest(name, names, 2);
    table.report(key, "there is no '" + name + "'", meant != nullptr ? "did you mean '" + *meant + "'?" : "",
                 "0103");
    return at;
  }

  void read_action(const TomlTable& table) {
    Action action;
    action.arm = named(table, "arm", arms_);
    if (table.has("pick")) {
      action.kind = ActionKind::Pick;
      action.object = named(table, "pick", objects_);
      action.grasp = table.has("grasp") || grasps_.size() != 1 ? named(table, "grasp", grasps_) : 0;
    } else if (table.has("place")) {
      action.kind = ActionKind::Place;
      action.object = named(table, "place", objects_);
      read_place(table, action);
    } else if (!table.boolean("move_away", false)) {
      table.report("arm", "an action has one of pick, place and move_away");
    }
    file_.sequence.push_back(std::move(action));
    actions_at_.push_back(table.where());
  }

  void read_place(const TomlTable& table, Action& action) {
    const std::string on = table.required_text("on");
    const std::size_t region = index_of(regions_, on), object = index_of(objects_, on);
    if (region < regions_.size())
      action.region = region;
    else if (object < objects_.size())
      action.on = object;
    else if (!on.empty())
      (void)named(table, "on", places_);
    if (table.has("angle_deg")) action.final_angle_rad = kDegree * table.number("angle_deg", 0.0, kTurns);
    for (const TomlTable& each : table.tables("beyond"))
      action.beyond.push_back({named(each, "object", objects_),
                               kDegree * each.number("direction_deg", 0.0, kTurns),
                               each.required_number("distance_m", {0.0, 9.0})});
  }

  const TomlTable& root_;
  std::filesystem::path folder_;
  SequenceFile file_;
  std::vector<result::Location> actions_at_;
  result::Diagnostics wrong_;
  std::vector<std::string> arms_, grasps_, regions_, objects_, places_;
};

}  // namespace

result::Result<SequenceFile> load_sequence(const std::filesystem::path& file) {
  auto document = settings::TomlDocument::load(file, "I");
  if (!document) return result::forward(document);
  const TomlTable root = (*document)->root();
  SequenceReader reader(root, file.parent_path());
  SequenceFile read = reader.read();
  result::Diagnostics problems = (*document)->finish();
  problems.insert(problems.end(), reader.wrong().begin(), reader.wrong().end());
  if (result::has_errors(problems)) return tl::unexpected(std::move(problems));
  if (auto sound = validate(read.cell, read.sequence, file.string(), reader.actions_at()); !sound)
    return result::forward(sound);
  return read;
}

}  // namespace stepwright::tamp
