#include "plant_models/assemblies/tugger_parameters.h"

#include <algorithm>
#include <cmath>

#include "plant_models/assemblies/requirements.h"
#include "plant_models/core/names.h"

namespace stepwright::assemblies {
namespace {

constexpr double kFarthestLink_m = 320.0;  // counts of centimetres in 16 bits
constexpr double kSteepestLock_rad = 1.5;  // its tangent is 14
constexpr std::size_t kMostBlockages = 1000;

void check_outlines(const std::vector<FloorPolygon>& outlines, const std::string& what,
                    Requirements& wanted) {
  for (std::size_t k = 0; k < outlines.size(); ++k) {
    const FloorPolygon& outline = outlines[k];
    const std::string name = what + " " + (outline.name.empty() ? std::to_string(k + 1) : outline.name);
    wanted.require(is_simple(outline.ring), name + " is no simple polygon",
                   "at least three corners, and no two sides that cross or touch");
    const bool near = std::all_of(outline.ring.begin(), outline.ring.end(), [](body2d::Vec2 corner) {
      return std::abs(corner.x) <= kFarthestLink_m && std::abs(corner.y) <= kFarthestLink_m;
    });
    wanted.require(near, name + " lies more than 320 m from the origin",
                   "position sensors count centimetres in 16 bits: move the origin into the hall");
  }
}

void check_place_names(const std::vector<FloorPolygon>& places, Requirements& wanted) {
  for (std::size_t k = 0; k < places.size(); ++k) {
    wanted.require(!places[k].name.empty(), "place " + std::to_string(k + 1) + " has no name");
    for (std::size_t i = 0; i < k; ++i) {
      wanted.require(!core::same_name(places[i].name, places[k].name),
                     "two places are called '" + places[k].name + "'", "upper and lower case are alike");
    }
  }
}

}  // namespace

std::size_t most_trailers(const TuggerParameters& p) {
  return std::max(p.trailers, p.most_trailers);
}

result::Result<void> validate(const TuggerParameters& p) {
  Requirements wanted;
  wanted.positive(p.links.wheelbase_m, "tugger: wheelbase_m");
  wanted.positive(p.links.hitch_m, "tugger: hitch_m");
  wanted.positive(p.links.length_m, "tugger: length_m");
  wanted.positive(p.links.width_m, "tugger: width_m");
  wanted.positive(p.links.spacing_m, "tugger: spacing_m");
  wanted.require(!(2.0 * p.links.spacing_m < p.links.length_m),
                 "tugger: spacing_m must be at least half of length_m", "every other link would overlap");
  wanted.positive(p.drive.top_speed_m_s, "tugger: top_speed_m_s");
  wanted.positive(p.drive.time_constant_s, "tugger: drive time_constant_s");
  wanted.positive(p.drive.acceleration_m_s2, "tugger: acceleration_m_s2");
  wanted.positive(p.drive.braking_m_s2, "tugger: braking_m_s2");
  wanted.positive(p.drive.spring_brake_m_s2, "tugger: spring_brake_m_s2");
  wanted.positive(p.drive.tractor_kg, "tugger: tractor_kg");
  wanted.not_negative(p.drive.trailer_kg, "tugger: trailer_kg");
  wanted.require(p.steering.full_lock_rad > 0.0 && p.steering.full_lock_rad < kSteepestLock_rad,
                 "tugger: full_lock_rad must lie between 0 and 1.5");
  wanted.positive(p.steering.time_constant_s, "tugger: steering time_constant_s");
  wanted.positive(p.steering.rate_rad_s, "tugger: rate_rad_s");
  wanted.require(p.slip.drive_slip >= 0.0 && p.slip.drive_slip < 1.0,
                 "tugger: drive_slip must lie in 0..1, 1 not included");
  wanted.not_negative(p.slip.understeer_s2_m2, "tugger: understeer_s2_m2");
  wanted.not_negative(p.slip.hitch_slip_s2_m2, "tugger: hitch_slip_s2_m2");
  wanted.not_negative(p.noise.position_m, "noise: position_m");
  wanted.not_negative(p.noise.heading_rad, "noise: heading_rad");
  wanted.not_negative(p.noise.speed_m_s, "noise: speed_m_s");
  wanted.not_negative(p.noise.hitch_rad, "noise: hitch_rad");
  wanted.require(most_trailers(p) <= kMostTuggerTrailers, "a train has at most 15 trailers");
  wanted.require(std::abs(p.start.position.x) <= kFarthestLink_m &&
                     std::abs(p.start.position.y) <= kFarthestLink_m && std::isfinite(p.start.angle),
                 "the tractor starts more than 320 m from the origin");
  wanted.require(p.blockages.size() <= kMostBlockages, "a hall has at most 1000 blockages");
  check_outlines(p.walls, "wall", wanted);
  check_outlines(p.obstacles, "obstacle", wanted);
  check_outlines(p.blockages, "blockage", wanted);
  check_outlines(p.places, "place", wanted);
  check_place_names(p.places, wanted);
  wanted.not_negative(p.scanner_m, "scanner_m");
  return wanted.finish();
}

}  // namespace stepwright::assemblies
