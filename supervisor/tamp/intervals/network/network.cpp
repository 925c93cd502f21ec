#include "supervisor/tamp/intervals/network/network.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "supervisor/tamp/intervals/sequence/region_shape.h"

namespace stepwright::tamp {
namespace {

const Span kAnywhere{-nanometres_of(kFarthest_m), nanometres_of(kFarthest_m)};

ArcSet arcs_of(std::span<const AngleRange> ranges) {
  ArcSet set;
  for (const AngleRange range : ranges) set.add(arc_outward(range.low_rad, range.high_rad));
  return set;
}

}  // namespace

Network::Network(const WorkCell& cell, NetworkOptions options)
    : cell_(&cell), options_(std::move(options)), current_(cell.objects.size()), held_(cell.arms.size()) {}

ConstraintId Network::add(Constraint constraint) {
  constraint.action = actions_.size() - 1;
  constraints_.push_back(constraint);
  return static_cast<ConstraintId>(constraints_.size() - 1);
}

std::uint32_t Network::add_spot() {
  spots_.push_back(kNone);
  lengths_.insert(lengths_.end(), 3, kAnywhere);
  is_awake_.push_back(false);
  return static_cast<std::uint32_t>(spots_.size() - 1);
}

AngleId Network::add_angle(std::uint32_t steps) {
  angles_.push_back(ArcSet::full());
  watches_.push_back({{kNone, kNone}, steps});
  return static_cast<AngleId>(angles_.size() - 1);
}

std::uint32_t Network::add_place(std::size_t object, std::uint32_t spot, std::int64_t rise_nm,
                                 std::uint32_t steps) {
  places_.push_back({object, spot, rise_nm, add_angle(steps)});
  watches_.back().spots[0] = spot;
  const auto place = static_cast<std::uint32_t>(places_.size() - 1);
  changed_places_.emplace_back(object, current_[object]);
  current_[object] = place;
  return place;
}

std::uint32_t Network::place_of(std::size_t object) {
  if (!current_[object]) put_start(object);
  return *current_[object];
}

void Network::put_start(std::size_t object) {
  const ObjectPose& start = cell_->objects[object].start;
  const std::uint32_t spot = add_spot();
  const std::uint32_t place = add_place(object, spot, 0, 0);
  const auto at = [](double m) {
    const std::int64_t nm = nanometres_of(m);
    return Span{nm, nm};
  };
  const ConstraintId position = add({.kind = ConstraintKind::StartPosition, .object = object});
  given(position, 3 * spot, at(start.x_m));
  given(position, 3 * spot + 1, at(start.y_m));
  given(add({.kind = ConstraintKind::StartHeight, .object = object}), 3 * spot + 2, at(start.z_m));
  given_angle(add({.kind = ConstraintKind::StartAngle, .object = object}), places_[place].angle,
              ArcSet::point(angle_of(start.angle_rad)));
}

bool Network::push(const Action& action) {
  frames_.push_back({places_.size(), visits_.size(), rows_.size(), spots_.size(), angles_.size(),
                     constraints_.size(), trail_.size(), changed_places_.size(), action.arm,
                     held_[action.arm], refuted_});
  actions_.push_back(action);
  if (action.kind == ActionKind::Pick) push_pick(action);
  if (action.kind == ActionKind::Place) push_place(action);
  if (action.kind == ActionKind::MoveAway) handlings_.push_back({});
  return propagate();
}

void Network::pop() {
  const Frame& frame = frames_.back();
  std::vector<double> multipliers = std::move(multipliers_);  // of a refutation before this action
  undo(frame.trail);
  if (frame.refuted) multipliers_ = std::move(multipliers);
  if (rows_.size() != frame.rows) program_.reset();
  while (visits_.size() > frame.visits) {
    const Visit& visit = visits_.back();
    spots_[places_[visit.place].spot] = before_.back();
    Watch& watch = watches_[visit.hand];
    (watch.spots[1] != kNone ? watch.spots[1] : watch.spots[0]) = kNone;
    visits_.pop_back();
    before_.pop_back();
  }
  while (changed_places_.size() > frame.changed_places) {
    current_[changed_places_.back().first] = changed_places_.back().second;
    changed_places_.pop_back();
  }
  places_.resize(frame.places);
  rows_.resize(frame.rows);
  spots_.resize(frame.spots);
  is_awake_.resize(frame.spots);
  lengths_.resize(3 * frame.spots);
  angles_.resize(frame.angles);
  watches_.resize(frame.angles);
  constraints_.resize(frame.constraints);
  held_[frame.arm] = frame.held;
  refuted_ = frame.refuted;
  handlings_.pop_back();
  actions_.pop_back();
  frames_.pop_back();
}

void Network::push_pick(const Action& action) {
  const std::uint32_t place = place_of(action.object);
  const Held held{action.object, action.grasp, add_angle(options_.hand_steps)};
  const std::vector<AngleRange>& allowed = cell_->grasps[action.grasp].angles;
  if (!allowed.empty())
    given_angle(add({.kind = ConstraintKind::GraspAngles, .object = action.object, .arm = action.arm}),
                held.hand, arcs_of(allowed));
  held_[action.arm] = held;
  add_visit(action, place, held);
}

void Network::push_place(const Action& action) {
  Held held = *held_[action.arm];
  const ConstraintId transfer =
      add({.kind = ConstraintKind::Transfer, .object = action.object, .arm = action.arm});
  if (!counts(transfer)) held.hand = add_angle(options_.hand_steps);
  const std::uint32_t place = action.region ? put_on_region(action) : put_on_object(action);
  if (action.final_angle_rad)
    given_angle(add({.kind = ConstraintKind::FinalAngle, .object = action.object, .arm = action.arm}),
                places_[place].angle, ArcSet::point(angle_of(*action.final_angle_rad)));
  add_beyond(action, place);
  held_[action.arm].reset();
  add_visit(action, place, held);
}

std::uint32_t Network::put_on_region(const Action& action) {
  const RegionShape shape = shape_of(cell_->regions[*action.region]);
  const std::uint32_t spot = add_spot();
  const std::uint32_t place =
      add_place(action.object, spot, 0, action.final_angle_rad ? 0 : options_.place_steps);
  const ConstraintId area = add({.kind = ConstraintKind::RegionArea,
                                 .object = action.object,
                                 .arm = action.arm,
                                 .region = action.region});
  given(area, 3 * spot, shape.x);
  given(area, 3 * spot + 1, shape.y);
  if (counts(area)) {
    for (const HalfPlane& side : shape.sides)
      rows_.push_back({area, {{3 * spot, side.x_factor}, {3 * spot + 1, side.y_factor}}, side.high_nm});
    if (!shape.sides.empty()) program_.reset();
    rows_awake_ = rows_awake_ || !shape.sides.empty();
  }
  const std::int64_t height_nm = nanometres_of(cell_->regions[*action.region].z_m);
  given(add({.kind = ConstraintKind::RegionHeight,
             .object = action.object,
             .arm = action.arm,
             .region = action.region}),
        3 * spot + 2, {height_nm, height_nm});
  return place;
}

std::uint32_t Network::put_on_object(const Action& action) {
  const std::uint32_t base = place_of(*action.on);
  const ConstraintId id =
      add({.kind = ConstraintKind::Stack, .object = action.object, .arm = action.arm, .which = *action.on});
  const std::uint32_t steps = action.final_angle_rad ? 0 : options_.place_steps;
  if (!counts(id)) return add_place(action.object, add_spot(), 0, steps);
  return add_place(action.object, places_[base].spot,
                   places_[base].rise_nm + nanometres_of(cell_->objects[*action.on].height_m), steps);
}

void Network::add_beyond(const Action& action, std::uint32_t place) {
  for (std::size_t k = 0; k < action.beyond.size(); ++k) {
    const Beyond& beyond = action.beyond[k];
    const LengthId other = 3 * places_[place_of(beyond.object)].spot, own = 3 * places_[place].spot;
    const ConstraintId id =
        add({.kind = ConstraintKind::Beyond, .object = action.object, .arm = action.arm, .which = k});
    if (!counts(id) || other == own) continue;
    const double c = std::cos(beyond.direction_rad), s = std::sin(beyond.direction_rad);
    rows_.push_back({id, {{own, -c}, {own + 1, -s}, {other, c}, {other + 1, s}}, -1e9 * beyond.distance_m});
    program_.reset();
    rows_awake_ = true;
  }
}

void Network::add_visit(const Action& action, std::uint32_t place, const Held& held) {
  handlings_.push_back({place, held.hand});
  const ConstraintId id = add({.kind = ConstraintKind::Reach, .object = action.object, .arm = action.arm});
  if (!counts(id)) return;
  const Grasp& grasp = cell_->grasps[held.grasp];
  const std::uint32_t spot = places_[place].spot;
  visits_.push_back({id, place, held.hand, cell_->arms[action.arm].reach,
                     places_[place].rise_nm + nanometres_of(grasp.height_m),
                     static_cast<std::int64_t>(std::ceil(grasp.radius_m * 1e9))});
  before_.push_back(spots_[spot]);
  spots_[spot] = static_cast<std::uint32_t>(visits_.size() - 1);
  Watch& watch = watches_[held.hand];
  (watch.spots[0] == kNone ? watch.spots[0] : watch.spots[1]) = spot;
  wake(spot);
}

}  // namespace stepwright::tamp
