#pragma once

// The constraints that a sequence of actions puts on its intervals: those of F. Lagriffoul, L. Karlsson,
// A. Saffiotti 2012 (location, transfer, grasp, manipulator), each as a part that can be taken away by
// itself, so that one can ask which of them conflict. Values.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "supervisor/tamp/intervals/reach/reach_bounds.h"

namespace stepwright::tamp {

enum class ConstraintKind : std::uint8_t {
  StartPosition,  // an object stands at this x and y at first
  StartHeight,
  StartAngle,
  GraspAngles,   // the hand's angle, seen from the object, is one that the grasp allows
  Reach,         // the arm reaches the tool's place with the tool's angle
  Transfer,      // an object in the hand turns as the hand does
  RegionArea,    // what is placed on a region lies within its rectangle
  RegionHeight,  // and at its height
  Stack,         // what is placed on an object lies above it
  FinalAngle,    // an object is placed with this angle
  Beyond,        // and lies beyond another one
};

// Numbered in the order in which actions bring them; the same for the same sequence.
using ConstraintId = std::uint32_t;

struct Constraint {
  ConstraintKind kind = ConstraintKind::Reach;
  std::size_t action = 0;  // in the sequence; of a start: that which picks the object first
  std::size_t object = 0;
  std::size_t arm = 0;
  std::optional<std::size_t> region = {};
  std::size_t which = 0;  // of an action's `beyond`
  friend bool operator==(const Constraint&, const Constraint&) = default;
};

using LengthId = std::uint32_t;
using AngleId = std::uint32_t;

// sum of factor * length <= high_nm.
struct LinearRow {
  struct Term {
    LengthId length = 0;
    double factor = 0.0;
  };
  ConstraintId constraint = 0;
  std::vector<Term> terms;
  double high_nm = 0.0;
};

}  // namespace stepwright::tamp
