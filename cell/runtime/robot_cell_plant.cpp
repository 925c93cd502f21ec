#include "cell/runtime/robot_cell_plant.h"

#include <numbers>
#include <string>

#include "cell/robot/robot_figures.h"
#include "plant_models/assemblies/robot_cell.h"

namespace stepwright::cell_runtime {
namespace {

double cell_radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

assemblies::FixedBody body_of(const config::FixedBodyConfig& body) {
  return {body.name,
          assemblies::box_solid({body.length_m, body.width_m, body.height_m}),
          {assemblies::turn_upright(cell_radians(body.place.heading_deg)),
           {body.place.x_m, body.place.y_m, body.z_m}},
          body.surface,
          false};
}

assemblies::ObjectFigures object_of(const config::CellObjectConfig& object) {
  using assemblies::ObjectKind;
  const ObjectKind kind = object.kind == "cup"    ? ObjectKind::Cup
                          : object.kind == "can"  ? ObjectKind::Can
                          : object.kind == "tray" ? ObjectKind::Tray
                                                  : ObjectKind::Box;
  return {object.name,
          kind,
          object.place.x_m,
          object.place.y_m,
          cell_radians(object.place.heading_deg),
          {object.length_m, object.width_m, object.height_m},
          object.mass_kg};
}

void set_robot_figures(const config::RobotCellPlantConfig& cell, assemblies::RobotCellParameters& p) {
  p.drive = {cell.drive.position_gain_1_s, cell.drive.time_constant_s, cell.drive.acceleration_rad_s2,
             cell.drive.inertia_kgm2,      cell.drive.brake_rad_s2,    cell.drive.following_rad};
  p.hand.speed_m_s = cell.hand.speed_m_s;
  p.hand.force_n = cell.hand.force_n;
  p.hand.stiffness_n_m = cell.hand.stiffness_n_m;
  p.hand.friction = cell.hand.friction;
  p.hand.slide_out_m = cell.hand.slide_out_m;
  p.camera.delay_s = cell.camera.delay_s;
  p.camera.loss = cell.camera.loss;
  p.camera.ghosts = cell.camera.ghosts;
  p.camera.position_m = cell.camera.position_m;
  p.camera.yaw_rad = cell.camera.yaw_rad;
  p.camera.slots = cell.camera.slots;
  p.encoder = {cell.encoder.noise_rad, cell.encoder.resolution_rad};
}

// Nothing is in something else at the start; who is to blame is where the file says it.
result::Result<void> check_start(const config::RobotCellPlantConfig& cell,
                                 const assemblies::RobotCellParameters& parameters) {
  auto made = assemblies::RobotCell::create(parameters);
  if (!made) return result::forward(made);
  const assemblies::RobotCellJudge& judge = (*made)->judge();
  result::Diagnostics problems;
  for (const assemblies::Incident& incident : judge.incidents()) {
    const std::size_t objects_from =
        parameters.arms.size() + parameters.fixed.size() + parameters.blockages.size();
    result::Location where = cell.robot_where;
    for (const std::size_t thing : {incident.a, incident.b}) {
      if (thing < cell.arms.size()) where = cell.arms[thing].where;
      if (thing >= objects_from && thing < objects_from + cell.objects.size())
        where = cell.objects[thing - objects_from].place.where;
    }
    problems.push_back({"C0322", result::Severity::Error, where,
                        judge.name(incident.a) + " is in " + judge.name(incident.b) + " at the start",
                        "objects stand on what is highest at their place; arms begin at start_rad"});
  }
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  return {};
}

}  // namespace

result::Result<assemblies::RobotCellParameters> robot_cell_parameters(const config::PlantConfig& plant) {
  const config::RobotCellPlantConfig& cell = plant.robot_cell;
  assemblies::RobotCellParameters parameters;
  for (const config::FixedBodyConfig& body : cell.fixed) parameters.fixed.push_back(body_of(body));
  for (const config::FixedBodyConfig& body : cell.blockages) parameters.blockages.push_back(body_of(body));
  for (const config::CellObjectConfig& object : cell.objects) parameters.objects.push_back(object_of(object));
  if (auto read = cell_robot::read_robot(cell, parameters); !read) return result::forward(read);
  set_robot_figures(cell, parameters);
  parameters.seed = plant.seed;
  if (!plant.uncertainty) assemblies::make_certain(parameters);
  if (auto right = check_start(cell, parameters); !right) return result::forward(right);
  return parameters;
}

std::vector<bridge::PortWire> robot_cell_wires(const config::PlantConfig& plant) {
  const config::RobotCellPlantConfig& cell = plant.robot_cell;
  std::vector<std::string> arms;
  for (const config::ArmConfig& arm : cell.arms) arms.push_back(arm.name);
  const std::size_t slots =
      cell.camera.slots > 0 ? cell.camera.slots : cell.objects.size() + cell.blockages.size() + 2;
  return bridge::default_robot_cell_wires(arms, slots);
}

}  // namespace stepwright::cell_runtime
