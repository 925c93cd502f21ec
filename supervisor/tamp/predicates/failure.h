#pragma once

// Why an action has no geometry with one choice of grasp and place, and what is in its way.
//
// Plain data and pure functions; any thread.

#include <cstdint>
#include <string>

#include "supervisor/tamp/scene/robot_cell.h"

namespace stepwright::tamp::predicates {

enum class FailureKind : std::uint8_t {
  NoRoom,      // what is placed would meet others, or not lie on the surface
  HandMeets,   // the hand would meet others
  OutOfReach,  // no values of the joints within the limits
  ArmMeets,    // the rest of the arm would meet something on the straight line
  NoPath,      // none was found within the nodes: no proof
  Impossible,  // the action makes no sense in this state
};

struct Failure {
  FailureKind kind = FailureKind::Impossible;
  // In the way: bit k of thing k, of furniture k; ArmMeets and NoPath do not know. Where furniture is, no
  // other place of a thing would do, and none is named.
  std::uint64_t things = 0, furniture = 0;
  void add(const Failure& next);  // becomes that, with what was in the way of one of its kind before
  bool proven() const { return kind != FailureKind::NoPath; }
};

// "no room: lid is in the way", "the hand meets can1 and can2", "out of reach".
std::string text_of(const scene::RobotCell& cell, const Failure& failure);

}  // namespace stepwright::tamp::predicates
