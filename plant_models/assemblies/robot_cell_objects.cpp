#include "plant_models/assemblies/robot_cell_objects.h"

#include <algorithm>
#include <cmath>

namespace stepwright::assemblies {
namespace {

constexpr double kFall_m_s2 = 9.81;
constexpr double kSetDown_m = 0.005;  // what is let go so little above a surface is set down
constexpr double kOnSurface_m = 1e-4;
constexpr double kStandingFriction = 0.4;

// Level, of a rectangle of that size around the frame's origin.
bool is_over(const Frame& frame, Vec3 size_m, Vec3 place) {
  const Vec3 local = frame.turn.back(place - frame.place);
  return std::abs(local.x) <= 0.5 * size_m.x && std::abs(local.y) <= 0.5 * size_m.y;
}

Vec3 whole_size(const ConvexSolid& solid) {
  const double grown = solid.round_m;
  return 2.0 * Vec3{solid.half_m.x + grown, solid.half_m.y + grown, solid.half_m.z + grown};
}

}  // namespace

CellObjects::CellObjects(const RobotCellParameters& parameters) : fixed_(parameters.fixed) {
  constexpr double kFromAbove_m = 1e3;
  objects_.reserve(parameters.objects.size());
  landings_.resize(parameters.objects.size());
  for (const ObjectFigures& figures : parameters.objects) {
    CellObject object;
    object.shape = shape_of(figures);
    object.pose = {{figures.x_m, figures.y_m, kFromAbove_m}, figures.yaw_rad};
    objects_.push_back(object);
    stand(objects_.size() - 1, surface_below(objects_.size() - 1, object.pose.place));
  }
}

bool CellObjects::is_on(std::size_t object, std::size_t below) const {
  for (std::size_t k = 0; k < objects_.size(); ++k) {  // no chain is longer
    const CellObject& here = objects_[object];
    if (here.state != ObjectState::Stands || here.support < kOnObject) return false;
    object = static_cast<std::size_t>(here.support - kOnObject);
    if (object == below) return true;
  }
  return false;
}

double CellObjects::mass_kg(std::size_t object) const {
  double mass = objects_[object].shape.mass_kg;
  for (std::size_t k = 0; k < objects_.size(); ++k)
    if (is_on(k, object)) mass += objects_[k].shape.mass_kg;
  return mass;
}

CellObjects::Surface CellObjects::surface_below(std::size_t object, Vec3 place) const {
  Surface highest;
  const auto consider = [&](int support, const Frame& frame, Vec3 size_m) {
    const double top = frame.place.z + 0.5 * size_m.z;
    if (top <= highest.top_m || top > place.z + kSetDown_m || !is_over(frame, size_m, place)) return;
    highest = {support, top};
  };
  for (std::size_t k = 0; k < fixed_.size(); ++k)
    if (fixed_[k].surface) consider(static_cast<int>(k) + 1, fixed_[k].frame, whole_size(fixed_[k].solid));
  for (std::size_t k = 0; k < objects_.size(); ++k) {
    if (k == object || objects_[k].state == ObjectState::Falls || is_on(k, object)) continue;
    for (const ObjectPart& part : objects_[k].shape.parts())
      if (part.surface)
        consider(kOnObject + static_cast<int>(k), objects_[k].pose.frame() * Frame{{}, part.middle},
                 part.size_m);
  }
  return highest;
}

double CellObjects::surface_below_m(std::size_t object, Vec3 place) const {
  return surface_below(object, place).top_m;
}

void CellObjects::stand(std::size_t object, const Surface& on) {
  CellObject& here = objects_[object];
  ObjectPose pose = here.pose;
  pose.place.z = on.top_m;
  move(object, pose);
  here.state = ObjectState::Stands;
  here.support = on.support;
  here.velocity_m_s = {};
}

void CellObjects::move(std::size_t object, const ObjectPose& pose) {
  const Frame before = objects_[object].pose.frame();
  const Frame now = pose.frame();
  const double turned = pose.yaw_rad - objects_[object].pose.yaw_rad;
  for (std::size_t k = 0; k < objects_.size(); ++k) {
    if (k == object || !is_on(k, object)) continue;
    ObjectPose& on = objects_[k].pose;
    on = {now * before.turn.back(on.place - before.place), on.yaw_rad + turned};
  }
  objects_[object].pose = pose;
}

void CellObjects::hold(std::size_t object) {
  objects_[object].state = ObjectState::Held;
  objects_[object].velocity_m_s = {};
}

void CellObjects::let_go(std::size_t object, Vec3 velocity_m_s) {
  CellObject& here = objects_[object];
  const Surface below = surface_below(object, here.pose.place);
  if (here.pose.place.z - below.top_m <= kSetDown_m) return stand(object, below);
  here.state = ObjectState::Falls;
  here.velocity_m_s = velocity_m_s;
  here.fell_from_m = here.pose.place.z;
}

void CellObjects::shake(std::size_t object, Vec3 acceleration_m_s2, double step_s) {
  const Vec3 level{acceleration_m_s2.x, acceleration_m_s2.y, 0.0};
  const double size = length(level);
  const double weight = kFall_m_s2 + acceleration_m_s2.z;
  const double missing = size - kStandingFriction * std::max(0.0, weight);
  if (missing <= 0.0) return;
  const Vec3 back = (-0.5 * missing * step_s * step_s / size) * level;
  for (std::size_t k = 0; k < objects_.size(); ++k) {
    const CellObject& on = objects_[k];
    if (on.state != ObjectState::Stands || on.support != kOnObject + static_cast<int>(object)) continue;
    move(k, {on.pose.place + back, on.pose.yaw_rad});
  }
}

bool CellObjects::restore(std::size_t object, const ObjectPose& pose, ObjectState state, int support) {
  const bool on_object = support >= kOnObject && support < kOnObject + static_cast<int>(objects_.size()) &&
                         support != kOnObject + static_cast<int>(object);
  const bool on_fixed = support >= 0 && support <= static_cast<int>(fixed_.size());
  if (!on_object && !on_fixed) return false;
  CellObject& here = objects_[object];
  here.pose = pose;
  here.state = state;
  here.support = support;
  here.velocity_m_s = {};
  here.fell_from_m = pose.place.z;
  return true;
}

bool CellObjects::is_supported(std::size_t object) const {
  const CellObject& here = objects_[object];
  const Surface below = surface_below(object, here.pose.place);
  return std::abs(below.top_m - here.pose.place.z) <= kOnSurface_m;
}

void CellObjects::fall(std::size_t object, double step_s) {
  CellObject& here = objects_[object];
  here.velocity_m_s.z -= kFall_m_s2 * step_s;
  const Vec3 next = here.pose.place + step_s * here.velocity_m_s;
  const Surface below = surface_below(object, {next.x, next.y, here.pose.place.z - kSetDown_m});
  if (next.z > below.top_m) return move(object, {next, here.pose.yaw_rad});
  move(object, {{next.x, next.y, below.top_m}, here.pose.yaw_rad});
  landings_[landed_++] = {object, below.support, here.fell_from_m - below.top_m};
  stand(object, below);
}

bool CellObjects::step(double step_s) {
  landed_ = 0;
  bool moved = false;
  for (std::size_t k = 0; k < objects_.size(); ++k) {
    CellObject& here = objects_[k];
    if (here.state == ObjectState::Stands && !is_supported(k)) {
      here.state = ObjectState::Falls;
      here.velocity_m_s = {};
      here.fell_from_m = here.pose.place.z;
    }
    if (here.state != ObjectState::Falls) continue;
    fall(k, step_s);
    moved = true;
  }
  return moved;
}

}  // namespace stepwright::assemblies
