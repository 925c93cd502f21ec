#include "plant_models/assemblies/robot_cell_judge.h"

#include <algorithm>
#include <limits>

#include "plant_models/assemblies/port_target.h"

namespace stepwright::assemblies {
namespace {

constexpr std::size_t kFirstBesideStand = 2;  // joints before it are near the robot's own stand

}  // namespace

RobotCellJudge::RobotCellJudge(const RobotCellParameters& parameters)
    : arms_(parameters.arms), fixed_(parameters.fixed), standing_(parameters.fixed.size()) {
  fixed_.insert(fixed_.end(), parameters.blockages.begin(), parameters.blockages.end());
  for (const ArmFigures& arm : arms_) names_.push_back(arm.name + " arm");
  for (const FixedBody& body : fixed_) names_.push_back(body.name);
  for (const ObjectFigures& object : parameters.objects) names_.push_back(object.name);
  names_.emplace_back("floor");
  for (std::size_t k = 0; k < arms_.size(); ++k) bodies_[k].resize(arms_[k].bodies.size());
  parts_.resize(parameters.objects.size());
  touching_.resize(names_.size() * names_.size());
  touched_.resize(touching_.size());
  incidents_.resize(kMostIncidents);
  if (arms_.size() == 2) smallest_gap_m_ = std::numeric_limits<double>::infinity();
}

void RobotCellJudge::note(const Incident& incident) {
  ++counts_[static_cast<std::size_t>(incident.kind)];
  if (noted_ < incidents_.size()) incidents_[noted_++] = incident;
}

void RobotCellJudge::contact(IncidentKind kind, std::size_t a, std::size_t b) {
  const std::size_t pair = a * names_.size() + b;
  if (touching_[pair]) return;
  touching_[pair] = true;
  if (!touched_[pair]) note({kind, a, b, now_s_, 0.0});
}

std::size_t RobotCellJudge::thing_of_support(int support) const {
  if (support >= kOnObject) return object_thing(static_cast<std::size_t>(support - kOnObject));
  return support > 0 ? fixed_thing(static_cast<std::size_t>(support) - 1) : names_.size() - 1;
}

void RobotCellJudge::note_drop(std::size_t object, int support, double height_m, double now_s) {
  note({IncidentKind::Dropped, object_thing(object), thing_of_support(support), now_s, height_m});
}

void RobotCellJudge::note_slip(std::size_t object, std::size_t arm, double now_s) {
  note({IncidentKind::Slipped, object_thing(object), arm, now_s, 0.0});
}

bool RobotCellJudge::touch(const PlacedSolid& a, const PlacedSolid& b) {
  return least_distance_m(a, b) < -kContactDepth_m && solid_distance_m(a, b) < -kContactDepth_m;
}

bool RobotCellJudge::touch(const PlacedSolid& a, const PlacedParts& parts) {
  return std::ranges::any_of(parts.all(), [&](const PlacedSolid& part) { return touch(a, part); });
}

void RobotCellJudge::place_bodies(const CellView& view) {
  for (std::size_t arm = 0; arm < arms_.size(); ++arm) {
    for (std::size_t k = 0; k < bodies_[arm].size(); ++k)
      bodies_[arm][k] = placed(arms_[arm].bodies[k], view.arms[arm], view.openings_m[arm]);
  }
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const CellObject& object = (*view.objects)[k];
    parts_[k].count = 0;
    for (const ObjectPart& part : object.shape.parts())
      parts_[k].solids[parts_[k].count++] = placed(part, object.pose);
  }
}

void RobotCellJudge::judge_arms() {
  double least = std::numeric_limits<double>::infinity();
  for (const PlacedSolid& a : bodies_[0]) {
    for (const PlacedSolid& b : bodies_[1]) {
      if (least_distance_m(a, b) < least) least = std::min(least, solid_distance_m(a, b));
    }
  }
  look_.arms_apart_m = std::max(0.0, least);
  smallest_gap_m_ = std::min(smallest_gap_m_, look_.arms_apart_m);
  if (least >= -kContactDepth_m) return;
  contact(IncidentKind::ArmArm, 0, 1);
  look_.arm_stopped = {true, true};
}

void RobotCellJudge::judge_arm_and_fixed(std::size_t arm, const CellView& view) {
  for (std::size_t k = 0; k < fixed_.size(); ++k) {
    if (k >= standing_ && !view.blocked[k - standing_]) continue;
    const PlacedSolid fixed{fixed_[k].solid, fixed_[k].frame};
    for (std::size_t body = 0; body < bodies_[arm].size(); ++body) {
      if (fixed_[k].of_robot && arms_[arm].bodies[body].joint < kFirstBesideStand) continue;
      if (!touch(bodies_[arm][body], fixed)) continue;
      contact(IncidentKind::ArmFixed, arm, fixed_thing(k));
      look_.arm_stopped[arm] = true;
      break;
    }
  }
}

void RobotCellJudge::judge_arm_and_objects(std::size_t arm, const CellView& view) {
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    if (view.held[arm] == static_cast<int>(k)) continue;
    for (std::size_t body = 0; body < bodies_[arm].size(); ++body) {
      if (!touch(bodies_[arm][body], parts_[k])) continue;
      contact(IncidentKind::ArmObject, arm, object_thing(k));
      look_.touches[look_.touch_count++] = {arm, body, k};
      break;
    }
  }
}

void RobotCellJudge::judge_objects(const CellView& view) {
  const CellObjects& objects = *view.objects;
  const auto any_of = [&](std::size_t object, const auto& meets) {
    return std::ranges::any_of(parts_[object].all(), meets);
  };
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    for (std::size_t other = k + 1; other < parts_.size(); ++other) {
      if (objects.is_on(k, other) || objects.is_on(other, k)) continue;
      if (any_of(k, [&](const PlacedSolid& a) { return touch(a, parts_[other]); }))
        contact(IncidentKind::ObjectObject, object_thing(k), object_thing(other));
    }
    const bool stands = objects[k].state == ObjectState::Stands;
    for (std::size_t body = 0; body < fixed_.size(); ++body) {
      if (body >= standing_ && !view.blocked[body - standing_]) continue;
      if (stands && objects[k].support == static_cast<int>(body) + 1) continue;
      const PlacedSolid fixed{fixed_[body].solid, fixed_[body].frame};
      if (any_of(k, [&](const PlacedSolid& a) { return touch(a, fixed); }))
        contact(IncidentKind::ObjectFixed, object_thing(k), fixed_thing(body));
    }
  }
}

bool RobotCellJudge::has_room(std::size_t blockage) const {
  const FixedBody& body = fixed_[standing_ + blockage];
  const PlacedSolid there{body.solid, body.frame};
  for (const std::vector<PlacedSolid>& arm : bodies_)
    for (const PlacedSolid& each : arm)
      if (touch(each, there)) return false;
  return std::ranges::none_of(parts_, [&](const PlacedParts& each) { return touch(there, each); });
}

const Look& RobotCellJudge::look(const CellView& view, double now_s) {
  now_s_ = now_s;
  look_ = {};
  std::swap(touching_, touched_);
  std::fill(touching_.begin(), touching_.end(), false);
  place_bodies(view);
  if (arms_.size() == 2) judge_arms();
  for (std::size_t arm = 0; arm < arms_.size(); ++arm) {
    judge_arm_and_fixed(arm, view);
    judge_arm_and_objects(arm, view);
  }
  judge_objects(view);
  return look_;
}

std::vector<ObjectPlace> RobotCellJudge::object_places(const CellObjects& objects) const {
  std::vector<ObjectPlace> found;
  for (std::size_t k = 0; k < objects.all().size(); ++k) {
    const CellObject& here = objects[k];
    const bool stands = here.state == ObjectState::Stands;
    found.push_back({name(object_thing(k)), stands ? name(thing_of_support(here.support)) : std::string(),
                     here.state, here.pose});
  }
  return found;
}

std::string RobotCellJudge::text(const Incident& incident) const {
  const std::string when = "t = " + number_text(incident.at_s) + " s: ";
  if (incident.kind == IncidentKind::Dropped)
    return when + name(incident.a) + " fell " + number_text(incident.height_m) + " m on " + name(incident.b);
  if (incident.kind == IncidentKind::Slipped)
    return when + name(incident.a) + " slipped in the hand of the " + name(incident.b);
  return when + name(incident.a) + " and " + name(incident.b) + " touched";
}

}  // namespace stepwright::assemblies
