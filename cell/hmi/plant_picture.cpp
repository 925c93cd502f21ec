#include "cell/hmi/plant_picture.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <utility>

#include "cell/hall/hall.h"
#include "cell/hmi/floor_picture.h"
#include "cell/hmi/hall_drawing.h"
#include "cell/hmi/model_drawing.h"
#include "cell/hmi/picture_points.h"
#include "cell/hmi/terminal_drawing.h"
#include "plant_models/assemblies/bench_ports.h"
#include "plant_models/assemblies/fleet_ports.h"
#include "plant_models/assemblies/line_ports.h"
#include "plant_models/assemblies/tugger_ports.h"
#include "plant_models/bridge/plant_driver.h"
#include "plant_models/components/library/catalogue.h"
#include "plant_models/components/model.h"
#include "plant_models/core/names.h"
#include "supervisor/map/map_file.h"

namespace stepwright::hmi {
namespace {

using core::PlantDescription;
using server::PointSourceKind;
using server::PointSources;

// A full tank whose sensor is uncertain by this much does not overflow.
constexpr double kSensorNoisePercent = 3;

class PictureBuilder {
 public:
  PictureBuilder(const PlantDescription& plant, const std::vector<config::PortAddress>& ports)
      : plant_(plant), points_(ports) {}

  PlantPicture build() {
    for (const auto& vehicle : plant_.vehicles) add_vehicle(vehicle);
    for (const auto& tank : plant_.tanks) add_tank(tank);
    for (const auto& pump : plant_.pumps) add_pump(pump);
    for (const auto& pipe : plant_.pipes) add_pipe(pipe);
    for (const auto& belt : plant_.belts) add_belt(belt);
    for (const auto& beam : plant_.beams) add_beam(beam);
    for (const auto& pusher : plant_.pushers) add_pusher(pusher);
    for (const auto& box : plant_.boxes) add_box(box);
    synoptic_.floor.estop_ok_point = points_.terminal("estop_ok", "estop_ok");
    synoptic_.points = std::move(points_.points);
    return {std::move(synoptic_), std::move(points_.sources)};
  }

 private:
  // The inverse of the static calibration, from counts without their tare.
  PointSources measured(const std::string& sensor) const {
    const auto index = core::index_of(plant_.sensors, sensor);
    if (sensor.empty() || !index) return {};
    const core::SensorDescription& found = plant_.sensors[*index];
    if (found.counts_per_unit == 0) return {};
    const double factor = 1 / found.counts_per_unit;
    const double offset = -found.counts_at_zero / found.counts_per_unit;
    PointSources sources = {{PointSourceKind::Tag, found.name + "_filtered", factor, offset, sensor}};
    if (const std::string* address = points_.address_of(sensor)) {
      sources.push_back({PointSourceKind::Address, *address, factor, offset, sensor});
    }
    return sources;
  }

  void add_vehicle(const core::VehicleDescription& vehicle) {
    protocol::Vehicle drawn{vehicle.name, vehicle.name, {}, {}, {}};
    drawn.position_point = points_.truth(vehicle.name + ".position", vehicle.name + " position", "m", false,
                                         vehicle.position_truth);
    drawn.left_point = points_.terminal(vehicle.name + ".left", vehicle.drive_left);
    drawn.right_point = points_.terminal(vehicle.name + ".right", vehicle.drive_right);
    synoptic_.vehicles.push_back(std::move(drawn));
    for (const auto& place : vehicle.places) {
      synoptic_.places.push_back({place.name, place.name, place.position,
                                  points_.terminal(place.switch_sensor, place.switch_sensor)});
    }
  }

  void add_tank(const core::TankDescription& tank) {
    protocol::Tank drawn{tank.name, tank.label, side_of(tank), place_of(tank), {}, {}, 0, 0};
    drawn.level_point = points_.add(tank.name + ".level", tank.label, "%", true, measured(tank.sensor));
    drawn.truth_point = points_.truth(tank.name + ".truth", tank.label + ", true", "%",
                                      !drawn.level_point.empty(), tank.level_truth);
    drawn.high_percent = tank.overflow_percent + kSensorNoisePercent;
    synoptic_.tanks.push_back(std::move(drawn));
  }

  // What fills a vehicle stands above the track.
  protocol::TankSide side_of(const core::TankDescription& tank) const {
    if (!tank.vehicle.empty()) return protocol::TankSide::OnVehicle;
    const bool fills = std::any_of(plant_.pipes.begin(), plant_.pipes.end(), [&](const auto& pipe) {
      const auto to = core::index_of(plant_.tanks, pipe.to);
      return pipe.from == tank.name && to && !plant_.tanks[*to].vehicle.empty();
    });
    return fills ? protocol::TankSide::Above : protocol::TankSide::Below;
  }

  // The vehicle that carries it, or the place nearest to it.
  std::string place_of(const core::TankDescription& tank) const {
    if (!tank.vehicle.empty()) return tank.vehicle;
    const protocol::Place* nearest = nullptr;
    for (const auto& place : synoptic_.places) {
      const double distance = std::abs(place.position - tank.position);
      if (nearest == nullptr || distance < std::abs(nearest->position - tank.position)) nearest = &place;
    }
    return nearest == nullptr ? std::string() : nearest->id;
  }

  void add_pump(const core::PumpDescription& pump) {
    protocol::Pump drawn{pump.actuator, pump.actuator, {}, {}};
    drawn.running_point = points_.terminal(pump.actuator, pump.actuator);
    drawn.flow_point =
        points_.truth(pump.actuator + ".flow", pump.actuator + " flow", "l/s", false, pump.flow_truth);
    synoptic_.pumps.push_back(std::move(drawn));
  }

  // Overflow lines carry nothing in normal operation and would hide the others.
  void add_pipe(const core::PipeDescription& pipe) {
    const auto pump = core::index_of(plant_.pumps, pipe.pump);
    if (!pump) return;
    synoptic_.pipes.push_back({pipe.from, pipe.to, plant_.pumps[*pump].actuator, pipe.at_place});
  }

  void add_belt(const core::BeltDescription& b) {
    const std::string running = b.actuator.empty() ? "" : points_.terminal(b.actuator, b.actuator);
    synoptic_.belts.push_back(
        {b.name, b.name, running, b.low_x, b.low_y, b.high_x, b.high_y, b.direction_x, b.direction_y});
    // One curve shows whether a drive is up to speed; a chute has none.
    if (!b.speed_truth.empty()) {
      points_.truth(b.name + ".speed", "belt " + b.name, "m/s", true, b.speed_truth);
    }
  }

  void add_beam(const core::BeamDescription& b) {
    synoptic_.beams.push_back({b.name, points_.terminal(b.name, b.name), b.from_x, b.from_y, b.to_x, b.to_y});
  }

  void add_pusher(const core::PusherDescription& p) {
    const std::string travel =
        points_.truth(p.name + ".travel", "pusher " + p.name, "m", false, p.travel_truth);
    synoptic_.pushers.push_back({p.name, p.name, points_.terminal(p.actuator, p.actuator), travel, p.home_x,
                                 p.home_y, p.length, p.thickness, p.direction_x, p.direction_y, p.stroke});
  }

  void add_box(const core::BoxDescription& b) {
    const std::string id = "box " + b.name;
    protocol::Box drawn{id, b.name, b.length, b.width, {}, {}, {}, {}};
    drawn.state_point = points_.truth(id + ".state", id, "", false, b.state_truth);
    drawn.x_point = points_.truth(id + ".x", id, "m", false, b.x_truth);
    drawn.y_point = points_.truth(id + ".y", id, "m", false, b.y_truth);
    drawn.angle_point = points_.truth(id + ".angle", id, "rad", false, b.angle_truth);
    synoptic_.boxes.push_back(std::move(drawn));
  }

  const PlantDescription& plant_;
  PicturePoints points_;
  protocol::Synoptic synoptic_;
};

// What of the configuration is to be seen; the walls are the map's.
assemblies::FleetParameters seen_of(const config::FleetPlantConfig& fleet) {
  const auto pose = [](const config::PlaceConfig& place) {
    return body2d::Pose{{place.x_m, place.y_m}, place.heading_deg * std::numbers::pi / 180.0};
  };
  assemblies::FleetParameters parameters;
  parameters.starts.resize(fleet.vehicles.size());
  for (const auto& pallet : fleet.pallets) parameters.pallets.push_back({pose(pallet.place), pallet.load_kg});
  for (const auto& block : fleet.blockages) {
    parameters.blockages.push_back({{{block.length_m, block.width_m}}, pose(block.place)});
  }
  return parameters;
}

// Those of the configuration, or the wires that there are without any.
std::vector<config::PortAddress> ports_or(const config::PlantConfig& plant,
                                          std::vector<bridge::PortWire> otherwise) {
  std::vector<config::PortAddress> ports = plant.ports;
  if (!ports.empty()) return ports;
  for (bridge::PortWire& wire : otherwise)
    ports.push_back({std::move(wire.port), std::move(wire.address), {}});
  return ports;
}

result::Result<PlantPicture> tugger_picture(const config::PlantConfig& plant) {
  auto parameters = cell_hall::hall_parameters(plant);
  if (!parameters) return result::forward(parameters);
  const std::vector<config::PortAddress> ports =
      ports_or(plant, bridge::default_tugger_wires(assemblies::most_trailers(*parameters),
                                                   cell_hall::place_names(*parameters)));
  PicturePoints points(ports);
  PlantPicture picture;
  picture.drawing = hall_drawing(assemblies::describe_tugger(*parameters), points);
  picture.synoptic.floor.estop_ok_point = points.terminal("estop_ok", "estop_ok");
  picture.synoptic.points = std::move(points.points);
  picture.sources = std::move(points.sources);
  return picture;
}

PlantPicture stepped_picture(const config::PlantConfig& plant) {
  PicturePoints points(plant.ports);
  PlantPicture picture;
  picture.drawing = terminal_drawing(plant.kind, plant.stepped, points);
  picture.synoptic.points = std::move(points.points);
  picture.sources = std::move(points.sources);
  return picture;
}

result::Result<PlantPicture> model_picture(const config::PlantConfig& plant) {
  auto text = components::read_model(plant.file, components::library::catalogue(),
                                     {.seed = plant.seed, .uncertainty = plant.uncertainty});
  if (!text) return result::forward(text);
  auto model = components::assemble(std::move(*text));
  if (!model) return result::forward(model);
  std::vector<bridge::PortWire> wires;
  for (const components::TerminalText& terminal : (*model)->text.terminals)
    wires.push_back({terminal.name, terminal.address, terminal.where});
  const std::vector<config::PortAddress> ports = ports_or(plant, std::move(wires));
  PicturePoints points(ports);
  PlantPicture picture;
  picture.drawing = model_drawing(**model, points);
  picture.synoptic.points = std::move(points.points);
  picture.sources = std::move(points.sources);
  return picture;
}

result::Result<PlantPicture> fleet_picture(const config::PlantConfig& plant) {
  std::optional<fleet::OccupancyGrid> map;
  if (!plant.fleet.map.empty()) {
    auto read = fleet::read_map(plant.fleet.map);
    if (!read) return result::forward(read);
    map = std::move(*read);
  }
  const std::vector<config::PortAddress> ports =
      ports_or(plant, bridge::default_fleet_wires(plant.fleet.vehicles.size()));
  PicturePoints points(ports);
  PlantPicture picture;
  picture.synoptic.floor =
      floor_of(assemblies::describe_fleet(seen_of(plant.fleet)), map ? &*map : nullptr, points);
  picture.synoptic.points = std::move(points.points);
  picture.sources = std::move(points.sources);
  return picture;
}

}  // namespace

PlantPicture picture_of(const PlantDescription& plant, const std::vector<config::PortAddress>& ports) {
  return PictureBuilder(plant, ports).build();
}

result::Result<PlantPicture> picture_of(const config::PlantConfig& plant) {
  if (plant.kind == "fleet") return fleet_picture(plant);
  if (plant.kind == "tugger") return tugger_picture(plant);
  if (config::is_stepped(plant.kind)) return stepped_picture(plant);
  if (plant.kind == "model") return model_picture(plant);
  if (plant.kind == "sorting_line") {
    assemblies::LineParameters parameters;
    parameters.seed = plant.seed;
    parameters.variety = plant.uncertainty;
    parameters.diverters = plant.diverters;
    parameters.boxes = plant.boxes;
    return picture_of(assemblies::describe_line(parameters), plant.ports);
  }
  if (plant.kind != "tank_bench") return PlantPicture{};
  return picture_of(assemblies::describe_bench({}), plant.ports);
}

}  // namespace stepwright::hmi
