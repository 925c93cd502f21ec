#pragma once

// The picture of a cell of arms for the page: its bodies and joints from the robot's model, what hands hold
// when and the ways of the tools from the schedule, and the variables of the program that tells where all of
// it is (supervisor/doc/pictures.md, arms).
//
// A pure function; any thread.
//
//   run::Pictures pictures;
//   pictures.own.push_back(page_picture(arms_picture({.cell = &cell, .schedule = &schedule, .start = &state,
//                                                     .program = &made, .digest = digest})));
//   show(pictures);

#include <string>

#include "supervisor/tamp/pictures/arms_picture.h"
#include "supervisor/tamp/program/arms_program.h"
#include "supervisor/tamp/scene/geometric_state.h"

namespace stepwright::tamp::pictures {

struct ArmsPictureInput {
  const scene::RobotCell* cell = nullptr;
  const schedule::CellSchedule* schedule = nullptr;  // null: nothing is planned, things stand
  const scene::GeometricState* start = nullptr;      // where its begin is; null: that of the cell's file
  const program::ArmsProgram* program = nullptr;     // whose variables; null: nothing tells where arms are
  std::string digest{};                              // of that program; empty: nothing is driven
};

ArmsPicture arms_picture(const ArmsPictureInput& input);

}  // namespace stepwright::tamp::pictures
