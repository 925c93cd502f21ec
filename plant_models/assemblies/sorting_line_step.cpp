// One step of the sorting line: drives, pushers, boxes, then what the sensors see.

#include <algorithm>
#include <cmath>

#include "plant_models/assemblies/sorting_line.h"

namespace stepwright::assemblies {
namespace {

constexpr double kStepS = 0.005;
constexpr double kPullInS = 0.04;      // until the contactor closes; it opens at once
constexpr double kPusherForceN = 200;  // more than this against it stalls a cylinder
constexpr double kSpringForceN = 100;  // the same on the way back
constexpr double kRunningM_s = 0.02;   // slower counts as standing
constexpr double kReaderReachM = 0.02;

}  // namespace

// False if a solver has given up.
bool SortingLine::step() {
  contactor_s_ = contactor_on_ && !emergency_stop_ ? contactor_s_ + kStepS : 0.0;
  contactor_closed_ = contactor_s_ >= kPullInS;
  if (!run_drives()) return false;
  move_pushers();
  note_collisions();
  let_boxes_arrive();
  carry_boxes();
  world_.step();
  for (const Box& box : boxes_) {
    if (box.state == BoxState::OnTheLine) {
      greatest_force_n_ = std::max(greatest_force_n_, world_.pressed_n(box.body));
    }
  }
  take_boxes_away();
  look();
  return true;
}

bool SortingLine::run_drives() {
  const double end_s = static_cast<double>(steps_ + 1) * kStepS;
  for (std::size_t i = 0; i < belts_.size(); ++i) {
    Belt& belt = belts_[i];
    belt.drive.command(belt.on && contactor_closed_);
    belt.drive.load(std::max(0.0, pulled_n_[i]));
    if (!belt.drive.advance_to(end_s)) return false;
    surfaces_[i].velocity = belt.drive.speed_m_s() * layout_.belts[i].direction;
    surfaces_[i].grip = parameters_.belt_grip * belt.slip;
  }
  return true;
}

// Without power the valve drops, and the cylinder's spring brings the paddle back.
void SortingLine::move_pushers() {
  for (std::size_t i = 0; i < pushers_.size(); ++i) {
    Pusher& pusher = pushers_[i];
    const PusherPlace& place = layout_.pushers[i];
    const body2d::Vec2 offset = world_.pose(pusher.body).position - place.home;
    pusher.travel_m = std::max(0.0, offset.x * place.direction.x + offset.y * place.direction.y);
    const bool out = pusher.on && contactor_closed_;
    const double target = out ? place.stroke_m : 0.0;
    double speed = std::clamp((target - pusher.travel_m) / kStepS, -parameters_.pusher.speed_back_m_s,
                              parameters_.pusher.speed_out_m_s);
    const body2d::Vec2 force = world_.force_n(pusher.body);
    const double pushed_out_n = force.x * place.direction.x + force.y * place.direction.y;
    const bool stalls = speed > 0.0 ? pushed_out_n < -kPusherForceN : pushed_out_n > kSpringForceN;
    if (pusher.stuck || stalls) speed = 0.0;
    world_.drive(pusher.body, speed * place.direction);
  }
}

// What an interlock has to prevent: a paddle across a belt that runs.
bool SortingLine::meets_a_belt(std::size_t pusher) const {
  const bool runs = belts_[layout_.pushers[pusher].belt].drive.speed_m_s() > kRunningM_s;
  return runs && pushers_[pusher].travel_m > parameters_.pusher.switch_m;
}

void SortingLine::note_collisions() {
  for (std::size_t i = 0; i < pushers_.size(); ++i) {
    const bool meets = meets_a_belt(i);
    if (meets && !pushers_[i].met_a_belt) ++collisions_;
    pushers_[i].met_a_belt = meets;
  }
}

void SortingLine::carry_boxes() {
  std::fill(pulled_n_.begin(), pulled_n_.end(), 0.0);
  for (const Box& box : boxes_) {
    if (box.state != BoxState::OnTheLine) continue;
    body2d::convey(world_, box.body, box.data.rectangle, surfaces_, parameters_.belt_grip, pulled_n_);
  }
}

// Upstream puts the next box on the infeed once that has been free for a while.
void SortingLine::let_boxes_arrive() {
  if (next_ == list_.size()) return;
  const body2d::Area& infeed = layout_.belts[layout_.infeed()].area;
  for (const Box& box : boxes_) {
    if (box.state != BoxState::OnTheLine) continue;
    const body2d::Vec2 at = world_.pose(box.body).position;
    const double tail = at.x - box.data.rectangle.size.x / 2.0;
    if (tail < infeed.high.x && infeed.contains({std::min(at.x, infeed.high.x), at.y})) free_s_ = 0.0;
  }
  free_s_ += kStepS;
  Box& box = boxes_[list_[next_]];
  if (free_s_ < box.data.wait_s) return;
  const body2d::Vec2 place = layout_.arrival + body2d::Vec2{0.0, box.data.offset_m};
  world_.place(box.body, {place, box.data.angle_rad}, {});
  world_.set_present(box.body, true);
  box.state = BoxState::OnTheLine;
  free_s_ = 0.0;
  ++next_;
}

void SortingLine::take_away(Box& box, BoxState state) {
  world_.set_present(box.body, false);
  box.state = state;
}

void SortingLine::take_boxes_away() {
  for (Box& box : boxes_) {
    if (box.state != BoxState::OnTheLine) continue;
    const body2d::Vec2 at = world_.pose(box.body).position;
    for (std::size_t i = 0; i < chutes_.size(); ++i) {
      if (!layout_.chutes[i].exit.contains(at)) continue;
      box.chute = static_cast<int>(i) + 1;
      box.rank = ++chutes_[i].got;
      take_away(box, BoxState::Delivered);
      break;
    }
    if (box.state == BoxState::OnTheLine && !layout_.bounds.contains(at)) take_away(box, BoxState::Fallen);
  }
}

bool SortingLine::sees(body2d::Vec2 from, body2d::Vec2 to) const {
  return std::any_of(boxes_.begin(), boxes_.end(), [&](const Box& box) {
    return box.state == BoxState::OnTheLine &&
           body2d::crosses(box.data.rectangle, world_.pose(box.body), from, to);
  });
}

void SortingLine::look() {
  for (std::size_t i = 0; i < eyes_.size(); ++i)
    eyes_[i].dark = sees(layout_.eyes[i].from, layout_.eyes[i].to);
  for (std::size_t i = 0; i < chutes_.size(); ++i) {
    const bool dark = sees(layout_.chutes[i].beam_from, layout_.chutes[i].beam_to);
    if (dark && !chutes_[i].dark && chutes_[i].counted < INT16_MAX) ++chutes_[i].counted;
    chutes_[i].dark = dark;
  }
}

// The reader stands at the eye of its belt and looks at the same point.
std::int16_t SortingLine::box_at_reader() const {
  const EyePlace& eye = layout_.eyes[layout_.reader()];
  const body2d::Vec2 reach{kReaderReachM, 0.0};
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    if (boxes_[i].state != BoxState::OnTheLine) continue;
    if (!body2d::crosses(boxes_[i].data.rectangle, world_.pose(boxes_[i].body), eye.from - reach, eye.to))
      continue;
    return static_cast<std::int16_t>(i + 1);
  }
  return 0;
}

}  // namespace stepwright::assemblies
