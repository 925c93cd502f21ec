#include "supervisor/tamp/scene/cell_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <string_view>
#include <utility>

#include "runtime/ground/settings/toml_document.h"
#include "supervisor/motion/robot/srdf_reader.h"
#include "supervisor/motion/robot/urdf_reader.h"
#include "supervisor/tamp/scene/starts.h"

namespace stepwright::tamp::scene {

namespace {

using settings::Range;
using settings::TomlTable;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr Range kCoordinate{-9.0, 9.0}, kTurns{-360.0, 360.0}, kSide{0.001, 9.0};
constexpr std::size_t kMostBytes = std::size_t{8} << 20U;
constexpr std::size_t kMostOfAKind = 64;
constexpr std::array<std::string_view, 5> kKinds = {"", "cup", "can", "tray", "box"};

// "cup1" is a cup; empty: the name does not say.
std::string kind_by_name(const std::string& name) {
  const std::string letters = name.substr(0, name.find_first_of("0123456789_-"));
  return std::ranges::find(kKinds, letters) == kKinds.end() ? std::string() : letters;
}

class CellReader {
 public:
  CellReader(const TomlTable& root, std::filesystem::path folder) : root_(root), folder_(std::move(folder)) {}

  const result::Diagnostics& wrong() const { return wrong_; }

  CellFile read() {
    file_.domain = folder_ / root_.required_text("domain");
    file_.problem = folder_ / root_.required_text("problem");
    read_manner();
    if (root_.has("obstacle")) file_.cell.obstacle = read_form(root_.table("obstacle"));
    for (const TomlTable& table : kind("furniture")) read_furniture(table);
    for (const TomlTable& table : kind("region")) read_surface(table);
    for (const TomlTable& table : kind("object")) read_thing(table);
    std::vector<ArmNames> arms;
    for (const TomlTable& table : kind("arm"))
      arms.push_back({new_name(table), table.required_text("group"), table.required_text("gripper")});
    if (arms.empty()) root_.report("", "a cell has at least one [[arm]]");
    check_overlaps();
    if (read_robot()) take(add_arms(file_.cell, arms, root_.where("robot")));
    return std::move(file_);
  }

 private:
  std::vector<TomlTable> kind(const char* key) {
    std::vector<TomlTable> tables = root_.tables(key);
    if (tables.size() > kMostOfAKind) {
      tables[kMostOfAKind].report("", "there are more than 64 of this kind");
      tables.resize(kMostOfAKind, tables.front());
    }
    return tables;
  }

  std::string new_name(const TomlTable& table) {
    std::string name = table.required_text("name");
    if (std::ranges::find(names_, name) != names_.end())
      table.report("name", "'" + name + "' is used twice", "names tell things, regions and arms apart",
                   "0101");
    names_.push_back(name);
    return name;
  }

  static Pose read_pose(const TomlTable& table) {
    return {table.required_number("x_m", kCoordinate), table.required_number("y_m", kCoordinate),
            table.required_number("z_m", kCoordinate), kDegree * table.number("angle_deg", 0.0, kTurns)};
  }

  static Form read_form(const TomlTable& table) {
    Form form;
    form.round = table.has("radius_m");
    form.height_m = table.required_number("height_m", kSide);
    if (form.round) {
      form.radius_m = table.required_number("radius_m", kSide);
    } else {
      form.size_x_m = table.required_number("size_x_m", kSide);
      form.size_y_m = table.required_number("size_y_m", kSide);
    }
    return form;
  }

  void read_manner() {
    Manner& manner = file_.cell.manner;
    manner.depth_m = root_.number("grasp_depth_m", manner.depth_m, {0.0, 0.1});
    manner.lift_m = root_.number("lift_m", manner.lift_m, {0.01, 1.0});
    manner.opening_m = root_.number("opening_m", manner.opening_m, {0.001, 0.05});
    const auto count = [&](const char* key, std::size_t fallback, double most) {
      return static_cast<std::size_t>(root_.integer(key, static_cast<std::int64_t>(fallback), {1.0, most}));
    };
    manner.grasps = count("grasps", manner.grasps, 1024);
    manner.places = count("places", manner.places, 100'000);
    manner.path_nodes = count("path_nodes", manner.path_nodes, 100'000);
  }

  void read_furniture(const TomlTable& table) {
    Furniture each{new_name(table), read_form(table), read_pose(table)};
    file_.cell.furniture.push_back(std::move(each));
  }

  void read_surface(const TomlTable& table) {
    Surface each{new_name(table), read_pose(table), table.required_number("size_x_m", kSide),
                 table.required_number("size_y_m", kSide)};
    file_.cell.surfaces.push_back(std::move(each));
  }

  void read_thing(const TomlTable& table) {
    Thing each{new_name(table),
               read_form(table),
               read_pose(table),
               table.boolean("turns", false),
               table.boolean("carries", false),
               {}};
    each.kind = table.text("kind", kind_by_name(each.name));
    if (std::ranges::find(kKinds, each.kind) == kKinds.end()) {
      table.report("kind", "a camera calls nothing '" + each.kind + "'",
                   "\"cup\", \"can\", \"tray\" or \"box\"");
    }
    places_.push_back(table.where());
    file_.cell.things.push_back(std::move(each));
  }

  void check_overlaps() {
    const RobotCell& cell = file_.cell;
    for (const StartOverlap& each : overlaps_of(cell)) {
      auto overlap = result::fail("G0102", places_[each.thing],
                                  "'" + cell.things[each.thing].name + "' overlaps with '" + each.other + "'",
                                  "z_m is the height of its underside");
      wrong_.insert(wrong_.end(), overlap.value().begin(), overlap.value().end());
    }
    constexpr double kStands_m = 1e-3;
    for (std::size_t k = 0; k < cell.things.size(); ++k) {
      const double above_m = above_ground_m(cell, k);
      if (above_m <= kStands_m) continue;
      char text[96];
      std::snprintf(text, sizeof text, " hangs %.1f mm above what is below it", 1e3 * above_m);
      file_.warnings.push_back(
          {"G0106", result::Severity::Warning, places_[k],
           "'" + cell.things[k].name + "'" + (std::isfinite(above_m) ? text : " stands on nothing"),
           "z_m is the height of its underside"});
    }
  }

  std::string text_of(const char* key) {
    const std::string path = (folder_ / root_.required_text(key)).string();
    std::ifstream in(path, std::ios::binary);
    std::string text(kMostBytes + 1, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    if (text.empty() || text.size() > kMostBytes)
      root_.report(key, "'" + path + "' cannot be read, is empty or too large");
    return text;
  }

  bool read_robot() {
    const std::string urdf = text_of("robot"), srdf = text_of("semantics");
    if (urdf.empty() || srdf.empty()) return false;
    RobotCell& cell = file_.cell;
    const std::filesystem::path urdf_path = folder_ / root_.text("robot", "");
    auto robot = motion::read_urdf(urdf, urdf_path.string());
    if (!robot) return take(robot);
    auto semantics = motion::read_srdf(srdf, (folder_ / root_.text("semantics", "")).string(), *robot);
    if (!semantics) return take(semantics);
    auto bodies = motion::read_bodies(*robot, motion::MeshLocator(urdf_path.parent_path()));
    if (!bodies) return take(bodies);
    cell.robot = *std::move(robot);
    cell.semantics = *std::move(semantics);
    cell.bodies = *std::move(bodies);
    return true;
  }

  template <typename T>
  bool take(const result::Result<T>& outcome) {
    if (!outcome) wrong_.insert(wrong_.end(), outcome.error().begin(), outcome.error().end());
    return static_cast<bool>(outcome);
  }

  TomlTable root_;
  std::filesystem::path folder_;
  CellFile file_;
  std::vector<std::string> names_;
  std::vector<result::Location> places_;
  result::Diagnostics wrong_;
};

}  // namespace

result::Result<CellFile> load_cell(const std::filesystem::path& file) {
  auto document = settings::TomlDocument::load(file, "G");
  if (!document) return result::forward(document);
  CellReader reader((*document)->root(), file.parent_path());
  CellFile read = reader.read();
  result::Diagnostics problems = (*document)->finish();
  problems.insert(problems.end(), reader.wrong().begin(), reader.wrong().end());
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  add_spheres(read.cell);
  return read;
}

}  // namespace stepwright::tamp::scene
