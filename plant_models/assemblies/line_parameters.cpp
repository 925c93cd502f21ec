#include "plant_models/assemblies/line_parameters.h"

#include <string>

#include "plant_models/assemblies/requirements.h"
#include "plant_models/core/counter_random.h"

namespace stepwright::assemblies {
namespace {

constexpr double kLength = 0.31;  // of a box, m
constexpr double kLengthSpread = 0.04;
constexpr double kWidth = 0.28;
constexpr double kWidthSpread = 0.03;
constexpr double kMass = 3.0;
constexpr double kMassSpread = 2.0;
constexpr double kOffsetSpread = 0.03;
constexpr double kAngleSpread = 0.08;
constexpr std::uint64_t kColours = 3;
constexpr std::uint64_t kColourDraws = 1000;  // behind all others

}  // namespace

result::Result<void> validate(const LineParameters& p) {
  Requirements wanted;
  wanted.require(p.diverters >= 1 && p.diverters <= 4, "a line has 1 to 4 diverters");
  wanted.require(p.boxes >= 1 && p.boxes <= 9, "an order list has 1 to 9 boxes");
  wanted.require(p.arrival_s > 0.0, "the time between arrivals must be positive");
  wanted.require(p.zone_m >= 0.8, "a zone must hold a box of 0.35 m with room to stop", "at least 0.8 m");
  wanted.require(p.belt_m >= 0.45, "a belt must be wider than the widest box", "at least 0.45 m");
  wanted.require(p.belt_grip > 0.0 && p.chute_speed_m_s > 0.0, "grip and chute speed must be positive");
  wanted.require(p.box_friction >= 0.0, "friction cannot be negative");
  const BeltDriveParameters& d = p.drive;
  wanted.require(d.nominal_speed_m_s > 0.0 && d.moved_mass_kg > 0.0 && d.current_time_s > 0.0,
                 "speed, mass and time constant of a drive must be positive");
  wanted.require(d.force_n_per_a * d.current_limit_a > d.friction_n,
                 "the drive's greatest force must exceed its friction", "raise current_limit_a");
  wanted.require(d.brake_n >= 0.0 && d.friction_n > 0.0, "friction and brake must stop a belt");
  wanted.require(p.pusher.speed_out_m_s > 0.0 && p.pusher.speed_back_m_s > 0.0,
                 "a pusher must move both ways");
  return wanted.finish();
}

std::vector<BoxData> make_boxes(const LineParameters& parameters) {
  const core::CounterRandom random(parameters.seed, 0xB0);
  std::vector<BoxData> boxes;
  for (std::size_t i = 0; i < parameters.boxes; ++i) {
    std::uint64_t draw = i * 8;
    const auto spread = [&](double size) {
      return parameters.variety ? size * random.symmetric(draw++) : 0.0;
    };
    BoxData box;
    box.rectangle.size.x = kLength + spread(kLengthSpread);
    box.rectangle.size.y = kWidth + spread(kWidthSpread);
    box.mass_kg = kMass + spread(kMassSpread);
    box.offset_m = spread(kOffsetSpread);
    box.angle_rad = spread(kAngleSpread);
    box.wait_s = parameters.arrival_s + spread(0.5 * parameters.arrival_s);
    if (parameters.variety) box.colour = static_cast<int>(random.bits(kColourDraws + i) % kColours) + 1;
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace stepwright::assemblies
