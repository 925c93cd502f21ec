#include "cell/config/robot_cell_config.h"

#include <algorithm>
#include <set>
#include <utility>

namespace stepwright::config {
namespace {

using settings::Range;
using settings::TomlTable;

constexpr Range kCellPlace_m{-3.2, 3.2};
constexpr Range kBody_m{0.001, 6.4};
constexpr Range kObject_m{0.005, 1.0};
constexpr Range kObject_kg{0.001, 50.0};
constexpr Range kShare{0.0, 1.0};
constexpr std::size_t kMostObjects = 16;
constexpr std::size_t kMostBlockages = 4;
constexpr std::size_t kMostLetters = 40;

void read_seven(const TomlTable& table, const char* key, Range range, SevenNumbers& numbers) {
  if (!table.has(key)) return;
  const std::vector<double> given = table.numbers(key);
  const bool right = given.size() == numbers.size() &&
                     std::all_of(given.begin(), given.end(),
                                 [&](double each) { return each >= range.low && each <= range.high; });
  if (!right)
    return table.report(key, "seven numbers are needed, one for each joint", "each of them within its range",
                        "0004");
  std::copy(given.begin(), given.end(), numbers.begin());
}

// A name of terminals and truths: letters, digits and underscores.
std::string read_name(const TomlTable& table, std::set<std::string>& taken) {
  std::string name = table.required_text("name");
  const bool plain =
      name.size() <= kMostLetters && std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
      });
  if (!plain)
    table.report("name", "'" + name + "' cannot name a thing of a robot cell",
                 "up to 40 letters, digits and '_'");
  else if (!name.empty() && !taken.insert(name).second)
    table.report("name", "there are two things with the name '" + name + "'");
  return name;
}

PlaceConfig read_cell_place(const TomlTable& table) {
  PlaceConfig place;
  place.x_m = table.required_number("x_m", kCellPlace_m);
  place.y_m = table.required_number("y_m", kCellPlace_m);
  place.heading_deg = table.number("heading_deg", 0.0, {-360.0, 360.0});
  place.where = table.where();
  return place;
}

ArmConfig read_arm(const TomlTable& table, std::set<std::string>& names) {
  ArmConfig arm;
  arm.name = read_name(table, names);
  arm.tip = table.text("tip", arm.name + "_tcp");
  arm.gripper = table.text("gripper", arm.name + "_gripper");
  read_seven(table, "start_rad", {-3.2, 3.2}, arm.start_rad);
  arm.where = table.where();
  return arm;
}

FixedBodyConfig read_body(const TomlTable& table, std::set<std::string>& names, bool surface) {
  FixedBodyConfig body;
  body.name = read_name(table, names);
  body.place = read_cell_place(table);
  body.z_m = table.required_number("z_m", kCellPlace_m);
  body.length_m = table.required_number("length_m", kBody_m);
  body.width_m = table.required_number("width_m", kBody_m);
  body.height_m = table.required_number("height_m", kBody_m);
  body.surface = surface && table.boolean("surface", true);
  return body;
}

CellObjectConfig read_object(const TomlTable& table, std::set<std::string>& names) {
  CellObjectConfig object;
  object.name = read_name(table, names);
  object.kind = table.choice("kind", object.kind, {"cup", "can", "tray", "box"});
  object.place = read_cell_place(table);
  for (const auto& [key, side] : {std::pair<const char*, double*>{"length_m", &object.length_m},
                                  {"width_m", &object.width_m},
                                  {"height_m", &object.height_m}})
    if (table.has(key)) *side = table.number(key, 0.0, kObject_m);
  if (table.has("mass_kg")) object.mass_kg = table.number("mass_kg", 0.0, kObject_kg);
  return object;
}

RobotDriveConfig read_robot_drive(const TomlTable& table) {
  RobotDriveConfig drive;
  drive.position_gain_1_s = table.number("position_gain_1_s", drive.position_gain_1_s, {1.0, 1'000.0});
  drive.time_constant_s = table.number("time_constant_s", drive.time_constant_s, {0.0005, 1.0});
  read_seven(table, "acceleration_rad_s2", {0.1, 1'000.0}, drive.acceleration_rad_s2);
  read_seven(table, "inertia_kgm2", {1e-4, 1'000.0}, drive.inertia_kgm2);
  drive.brake_rad_s2 = table.number("brake_rad_s2", drive.brake_rad_s2, {0.1, 1'000.0});
  drive.following_rad = table.number("following_rad", drive.following_rad, {0.001, 10.0});
  return drive;
}

RobotHandConfig read_robot_hand(const TomlTable& table) {
  RobotHandConfig hand;
  hand.speed_m_s = table.number("speed_m_s", hand.speed_m_s, {0.001, 10.0});
  hand.force_n = table.number("force_n", hand.force_n, {0.1, 10'000.0});
  hand.stiffness_n_m = table.number("stiffness_n_m", hand.stiffness_n_m, {1.0, 1e8});
  hand.friction = table.number("friction", hand.friction, {0.01, 10.0});
  hand.slide_out_m = table.number("slide_out_m", hand.slide_out_m, {0.001, 0.5});
  return hand;
}

CellCameraConfig read_camera(const TomlTable& table) {
  CellCameraConfig camera;
  camera.delay_s = table.number("delay_s", camera.delay_s, {0.0, 60.0});
  camera.loss = table.number("loss", camera.loss, kShare);
  camera.ghosts = table.number("ghosts", camera.ghosts, kShare);
  camera.position_m = table.number("position_m", camera.position_m, kShare);
  camera.yaw_rad = table.number("yaw_rad", camera.yaw_rad, {0.0, 3.0});
  camera.slots = static_cast<std::size_t>(table.integer("slots", 0, {0, 24}));
  return camera;
}

}  // namespace

RobotCellPlantConfig read_robot_cell_plant(const TomlTable& plant, const std::filesystem::path& folder) {
  RobotCellPlantConfig cell;
  cell.robot = read_plant_file(plant, "robot", folder);
  cell.robot_where = plant.where("robot");
  if (!plant.has("robot"))
    plant.report("kind", "a robot cell without a robot",
                 "robot = \"two_arms.urdf\", with its links and joints");
  std::set<std::string> names;
  for (const TomlTable& table : plant.tables("arms")) cell.arms.push_back(read_arm(table, names));
  if (cell.arms.empty() || cell.arms.size() > 2)
    plant.report(plant.has("arms") ? "arms" : "kind", "a robot cell has one or two arms",
                 "[[plant.arms]] with a name and the link between its fingers, tip");
  for (const TomlTable& table : plant.tables("fixed")) cell.fixed.push_back(read_body(table, names, true));
  for (const TomlTable& table : plant.tables("objects")) cell.objects.push_back(read_object(table, names));
  if (cell.objects.size() > kMostObjects) plant.report("objects", "a robot cell has at most 16 objects");
  for (const TomlTable& table : plant.tables("blockages"))
    cell.blockages.push_back(read_body(table, names, false));
  if (cell.blockages.size() > kMostBlockages)
    plant.report("blockages", "a robot cell has at most 4 blockages");
  cell.drive = read_robot_drive(plant.table("drive"));
  cell.hand = read_robot_hand(plant.table("hand"));
  cell.camera = read_camera(plant.table("camera"));
  const TomlTable encoder = plant.table("encoder");
  cell.encoder.noise_rad = encoder.number("noise_rad", cell.encoder.noise_rad, {0.0, 0.1});
  cell.encoder.resolution_rad = encoder.number("resolution_rad", cell.encoder.resolution_rad, {1e-7, 0.1});
  return cell;
}

}  // namespace stepwright::config
