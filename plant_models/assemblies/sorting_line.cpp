#include "plant_models/assemblies/sorting_line.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <utility>

#include "runtime/base/hash64.h"

namespace stepwright::assemblies {
namespace {

using body2d::BodyId;

constexpr std::chrono::nanoseconds kStep{5'000'000};
constexpr double kStepS = 0.005;
constexpr double kWallFriction = 0.2;
constexpr double kObstacleFriction = 0.6;
constexpr body2d::Rectangle kObstacle = {{0.05, 0.24}};
constexpr double kObstacleAngle = 0.25;  // it turns what it stops
constexpr double kObstacleWay =
    0.08;  // behind the beginning of its belt, so that a box reaches back to its eye

Vec2 obstacle_place(const BeltPlace& belt) {
  const Vec2 middle = 0.5 * (belt.area.low + belt.area.high);
  const double way = kObstacleWay - (belt.area.high.x - belt.area.low.x) / 2.0;
  return middle + way * belt.direction;
}

}  // namespace

SortingLine::SortingLine(const LineParameters& parameters)
    : parameters_(parameters),
      layout_(make_layout(parameters)),
      ports_(make_ports(layout_, parameters.boxes)),
      description_(describe_line(parameters)),
      world_({.step_s = kStepS}),
      eyes_(layout_.eyes.size()),
      chutes_(layout_.chutes.size()) {}

result::Result<std::unique_ptr<SortingLine>> SortingLine::create(const LineParameters& parameters) {
  if (auto valid = validate(parameters); !valid) return result::forward(valid);
  std::unique_ptr<SortingLine> line(new SortingLine(parameters));
  if (auto added = line->add_drives(); !added) return result::forward(added);
  line->add_bodies();
  return line;
}

result::Result<void> SortingLine::add_drives() {
  for (const BeltPlace& place : layout_.belts) {
    auto drive = BeltDrive::create(parameters_.drive);
    if (!drive) return result::forward(drive);
    belts_.push_back({.drive = std::move(*drive), .on = false, .slip = 1.0, .obstacle = {}});
    surfaces_.push_back({place.area, {}, parameters_.belt_grip});
  }
  for (const ChutePlace& place : layout_.chutes) {
    surfaces_.push_back({place.area, parameters_.chute_speed_m_s * place.direction, parameters_.belt_grip});
  }
  pulled_n_.assign(surfaces_.size(), 0.0);
  return {};
}

void SortingLine::add_bodies() {
  for (const WallPlace& wall : layout_.walls) world_.add_wall(wall.from, wall.to, kWallFriction);
  for (const PusherPlace& place : layout_.pushers) {
    const body2d::Rectangle paddle{{place.length_m, parameters_.pusher.thickness_m}};
    pushers_.push_back({.body = world_.add_paddle(paddle, {place.home, 0.0}, parameters_.box_friction)});
  }
  for (std::size_t i = 0; i < belts_.size(); ++i) {
    belts_[i].obstacle =
        world_.add_paddle(kObstacle, {obstacle_place(layout_.belts[i]), kObstacleAngle}, kObstacleFriction);
    world_.set_present(belts_[i].obstacle, false);
  }
  for (BoxData& data : make_boxes(parameters_)) {
    const body2d::BoxBody body{data.rectangle, data.mass_kg, parameters_.box_friction};
    // Announced boxes wait where nothing is.
    const Vec2 aside{layout_.arrival.x, layout_.bounds.high.y + 1.0 + static_cast<double>(boxes_.size())};
    const BodyId id = world_.add_box(body, {aside, 0.0});
    world_.set_present(id, false);
    list_.push_back(boxes_.size());
    boxes_.push_back({.data = data, .body = id});
  }
  world_.warm_up(40);
  look();
}

void SortingLine::set_actuator(core::ActuatorId id, std::int16_t value) {
  const bool on = value != 0;
  assert(id.value < ports_.actuators.size());
  const auto target = ports_.actuator_targets[id.value];
  switch (target.kind) {
    case LineActuator::Belt:
      belts_[target.index].on = on;
      return;
    case LineActuator::Pusher:
      pushers_[target.index].on = on;
      return;
    case LineActuator::Contactor:
      contactor_on_ = on;
      return;
  }
}

core::PlantStatus SortingLine::advance_to(std::chrono::nanoseconds time) {
  while (!failed_ && (steps_ + 1) * kStep <= time) {
    failed_ = !step();
    ++steps_;
  }
  if (failed_) return core::PlantStatus::Failed;
  now_ = std::max(now_, time);
  return core::PlantStatus::Good;
}

std::int16_t SortingLine::sensor(core::SensorId id) const {
  assert(id.value < ports_.sensors.size());
  const auto target = ports_.sensor_targets[id.value];
  const std::size_t i = target.index;
  switch (target.kind) {
    case LineSensor::Eye:
      return eyes_[i].shows >= 0 ? eyes_[i].shows : std::int16_t{eyes_[i].dark};
    case LineSensor::Home:
      return pushers_[i].travel_m <= parameters_.pusher.switch_m ? 1 : 0;
    case LineSensor::Out:
      return pushers_[i].travel_m >= layout_.pushers[i].stroke_m - parameters_.pusher.switch_m ? 1 : 0;
    case LineSensor::Contactor:
      return contactor_closed_ ? 1 : 0;
    case LineSensor::EmergencyStop:
      return emergency_stop_ ? 0 : 1;
    case LineSensor::Reset:
      return reset_ ? 1 : 0;
    case LineSensor::Reader:
      return box_at_reader();
    case LineSensor::ReaderLength: {
      const std::int16_t box = box_at_reader();
      if (box == 0) return 0;
      return static_cast<std::int16_t>(
          std::lround(1e3 * boxes_[static_cast<std::size_t>(box) - 1].data.rectangle.size.x));
    }
    case LineSensor::ReaderColour: {
      const std::int16_t box = box_at_reader();
      return box == 0 ? std::int16_t{0}
                      : static_cast<std::int16_t>(boxes_[static_cast<std::size_t>(box) - 1].data.colour);
    }
    case LineSensor::Counter:
      return chutes_[i].counted;
  }
  return 0;
}

double SortingLine::truth(core::TruthId id) const {
  assert(id.value < ports_.truths.size());
  const auto target = ports_.truth_targets[id.value];
  const std::size_t i = target.index;
  switch (target.kind) {
    case LineTruth::BoxX:
      return world_.pose(boxes_[i].body).position.x;
    case LineTruth::BoxY:
      return world_.pose(boxes_[i].body).position.y;
    case LineTruth::BoxAngle:
      return world_.pose(boxes_[i].body).angle;
    case LineTruth::BoxState:
      return static_cast<double>(boxes_[i].state);
    case LineTruth::BoxChute:
      return boxes_[i].chute;
    case LineTruth::BoxRank:
      return boxes_[i].rank;
    case LineTruth::BeltSpeed:
      return belts_[i].drive.speed_m_s();
    case LineTruth::PusherTravel:
      return pushers_[i].travel_m;
    case LineTruth::Delivered:
      return static_cast<double>(count(BoxState::Delivered));
    case LineTruth::OnTheLine:
      return static_cast<double>(count(BoxState::OnTheLine));
    case LineTruth::Energy:
      return world_.kinetic_energy_j();
    case LineTruth::GreatestForce:
      return greatest_force_n_;
    case LineTruth::Collisions:
      return collisions_;
  }
  return 0.0;
}

std::size_t SortingLine::count(BoxState state) const {
  std::size_t found = 0;
  for (const Box& box : boxes_) found += box.state == state ? 1u : 0u;
  return found;
}

std::uint64_t SortingLine::state_hash() const {
  std::uint64_t hash = world_.hash();
  const auto mix = [&hash](double value) {
    hash = base::hash_mix(hash, std::bit_cast<std::uint64_t>(value));
  };
  for (const Belt& belt : belts_) mix(belt.drive.speed_m_s()), mix(belt.drive.current_a());
  for (const Pusher& pusher : pushers_) mix(pusher.travel_m);
  for (const Box& box : boxes_) mix(static_cast<double>(box.state)), mix(box.chute), mix(box.rank);
  for (const Chute& chute : chutes_) mix(chute.counted);
  return hash;
}

}  // namespace stepwright::assemblies
