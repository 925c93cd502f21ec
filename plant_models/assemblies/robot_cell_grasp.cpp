#include "plant_models/assemblies/robot_cell_grasp.h"

#include <algorithm>
#include <cmath>

namespace stepwright::assemblies {
namespace {

constexpr double kGravity_m_s2 = 9.81;
constexpr double kLevel = 0.1;          // the most z part of the pads' direction
constexpr double kSquare = 0.98;        // cosine of what a box may be turned in the hand
constexpr double kRoundOff = 0.3;       // of the radius, beside the pads
constexpr double kAboveEnds_m = 0.015;  // pads reach so far beyond the tool's point

double yaw_of(const Frame& tool) {
  const Vec3 y = tool.turn.column(1);
  return std::atan2(-y.x, y.y);
}

}  // namespace

std::optional<Fit> fit_between(const Frame& tool, const ObjectPose& pose, const ObjectPart& part) {
  const Vec3 along = tool.turn.column(1);
  if (!part.grip || std::abs(along.z) > kLevel) return std::nullopt;
  const Vec3 middle = pose.frame() * part.middle;
  const Vec3 away = middle - tool.place;
  const double half_height = 0.5 * part.size_m.z;
  if (std::abs(away.z) > half_height + kAboveEnds_m) return std::nullopt;
  // Level, at a right angle to the pads' direction; how far a pad reaches along it.
  Vec3 level = cross(along, {0.0, 0.0, 1.0});
  level = (1.0 / length(level)) * level;
  const double off = std::abs(dot(away, level));
  const double reach = kPadAcross_m * std::abs(dot(tool.turn.column(0), level)) +
                       kPadAlong_m * std::abs(dot(tool.turn.column(2), level));
  const double side = dot(away, along);
  if (part.solid.kind == SolidKind::Cylinder) {
    const double radius = 0.5 * part.size_m.x;
    const double beside = std::max(0.0, off - reach);
    if (beside > kRoundOff * radius) return std::nullopt;
    return Fit{2.0 * std::sqrt(radius * radius - beside * beside), side};
  }
  const Vec3 x = turn_upright(pose.yaw_rad).column(0);
  const double cosine = std::abs(dot(x, along));
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const bool by_x = cosine >= kSquare;
  if (!by_x && sine < kSquare) return std::nullopt;
  const double width = by_x ? part.size_m.x : part.size_m.y;
  const double other = by_x ? part.size_m.y : part.size_m.x;
  if (off > 0.5 * other + reach) return std::nullopt;
  return Fit{width, side};
}

Grasp grasped(std::size_t object, double width_m, const Frame& tool, const ObjectPose& pose) {
  Grasp grasp;
  grasp.object = object;
  grasp.width_m = width_m;
  grasp.offset = tool.turn.back(pose.place - tool.place);
  grasp.turned_rad = pose.yaw_rad - yaw_of(tool);
  grasp.up = tool.turn.back({0.0, 0.0, 1.0});
  return grasp;
}

ObjectPose carried(const Grasp& grasp, const Frame& tool) {
  return {tool * grasp.offset, grasp.turned_rad + yaw_of(tool)};
}

double tilt_rad(const Grasp& grasp, const Frame& tool) {
  return std::acos(std::clamp((tool.turn * grasp.up).z, -1.0, 1.0));
}

void slide(Grasp& grasp, const Frame& tool, const Holding& holding) {
  const Vec3 pads = tool.turn.column(1);
  const auto along_pads = [&](Vec3 v) { return v - dot(v, pads) * pads; };
  const Vec3 pulled = along_pads(Vec3{0.0, 0.0, -kGravity_m_s2} - holding.acceleration_m_s2);
  const double held = 2.0 * holding.friction * holding.force_n / holding.mass_kg;
  // Friction takes away speed, but does not turn it round.
  const Vec3 free = along_pads(grasp.sliding_m_s) + holding.step_s * pulled;
  const double speed = length(free);
  const double left = std::max(0.0, speed - holding.step_s * held);
  grasp.sliding_m_s = left > 0.0 ? (left / speed) * free : Vec3{};
  grasp.offset = grasp.offset + tool.turn.back(holding.step_s * grasp.sliding_m_s);
  grasp.slid_m += holding.step_s * left;
}

}  // namespace stepwright::assemblies
