#pragma once

// A schedule of a cell's arms as a program that runs in the scan: a chart for each arm, one for the cell, and
// one for the camera; paths as data for MC_MovePath (supervisor/doc/arms_program.md). Two more are made of
// the same parts: one that brings the arms to rest on the paths that they are on, and one that only looks.
//
// A pure function; the result is a value. The same input gives the same text.
//
//   auto made = arms_program({.kind = ArmsProgramKind::Follow, .cell = &cell, .schedule = &schedule},
//                            cell_terminals_in_a_row(2, 4));
//   if (!made) ...
//   driver::compile({.texts = {}, .projects = {&made->project}});

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ladder/graphic/project.h"
#include "runtime/ground/result/result.h"
#include "supervisor/tamp/program/cell_terminals.h"
#include "supervisor/tamp/schedule/arm_schedule.h"

namespace stepwright::tamp::program {

// Charts: an arm's is kArmChart + "_" + its name ("arm_left").
inline constexpr const char* kCellChart = "cell";
inline constexpr const char* kArmChart = "arm";
inline constexpr const char* kCameraChart = "camera";

enum class ArmsProgramKind : std::uint8_t {
  Follow,   // the schedule
  Halt,     // to rest on the paths of a Follow program of the same schedule, by an online change
  Observe,  // nothing moves: the camera, and where the joints are
};

// Why a Follow program has ended without being done: the variable `cause`.
enum class StopCause : std::uint8_t {
  None = 0,
  MissedGrasp = 1,  // the fingers closed, and there was nothing, or something of another width
  LostGrasp = 2,    // what was held slipped or fell
  DriveFault = 3,   // a drive tripped, or is far from its set points
  Interlock = 4,    // arms came nearer to each other than they may (MC_WatchDistance)
  EmergencyStop = 5,
  NotAtStart = 6,  // an arm is not where the schedule begins
  Refused = 7,     // a block refused its command: `error_ARM` says why
  Fingers = 8,     // they did not come to their opening
};
const char* name_of(StopCause cause);  // "missed grasp"

enum class ArmsStepKind : std::uint8_t {
  Start,  // of every chart
  Fingers,
  Approach,
  Linear,
  Grip,
  Lift,
  Transfer,
  Lower,
  Release,  // schedule::StepKind
  Done,     // of every chart but the camera's
  Run,      // the cell's: arms are at work
  Stopped,  // the cell's: it was stopped, and `cause` says why; the arms stay in their steps
  Halt,     // Halt: on the way to rest
  Observe,  // Observe: until there are enough reports
};

struct ArmsStep {
  std::string chart{};
  std::string name{};
  ArmsStepKind kind = ArmsStepKind::Start;
  int arm = -1;                       // of the cell
  std::size_t action = 0;             // of the plan; of an arm's own steps
  std::size_t step = 0;               // of its ArmSchedule
  StopCause cause = StopCause::None;  // of the cell's Stopped steps: there is one for each cause
};

// Names of global variables that others read. Those of an arm end with "_" and its name.
struct ArmVariables {
  std::vector<std::string> joints;   // LREAL, rad, as measured: "joint_left_1"
  std::string width;                 // LREAL, m: between the fingers, as measured
  std::vector<std::string> angles;   // INT, 0.0001 rad: the same as terminals say it, "pos_left_1"
  std::string opening;               // INT, 0.1 mm: likewise
  std::string progress;              // LREAL: schedule::Wait
  std::string state, error;          // INT, UINT: of the group of axes (MC_GROUP_STATE, ErrorID)
  std::string failed_joint;          // INT: the one that did not follow, from 1; 0: none
  std::string failed_at, failed_by;  // LREAL, rad: where it was then, and how far from its set point
  std::string standing;              // BOOL: set points do not change
  std::string waiting;               // BOOL: it stands or slows down for the other arm
  std::string grasped;               // BOOL: the fingers hold something of the width that is meant
  std::string grip_seen;             // BOOL: the grasp switch itself
};

struct CameraVariables {
  std::string reports;  // INT: how many there have been since the program began
  std::string seen;     // INT: objects in the last one
  // INT, of the last one by slot; kind 0: nothing. 0.1 mm, 0.0001 rad.
  std::vector<std::string> kind, x, y, z, yaw;
  // The latest `kept` reports by number and slot, as elements of arrays: "seen_x[7]" is slot 8 - slots of
  // the second one if there are 6 slots. Report n is at n modulo `kept`, the first one being 0.
  std::size_t kept = 0;
  std::string all_kind, all_x, all_y, all_z, all_yaw;  // ARRAY[0..kept * slots - 1] OF INT
};

struct ArmsVariables {
  std::vector<ArmVariables> arms;  // in the cell's order
  CameraVariables camera;
  std::string cause = "cause";             // INT: StopCause
  std::string cause_arm = "cause_arm";     // INT: number of the arm from 1, 0: none of them
  std::string distance = "arms_distance";  // LREAL, m: of the arms as measured; only with two
  std::string room = "arms_room";          // LREAL, m: what MC_WatchDistance goes by
  std::string rest = "at_rest";            // BOOL: no arm moves
  // For people: these are written.
  std::string hold = "operator_hold";        // BOOL: both arms stand on their paths while it is on
  std::string speed = "operator_speed";      // LREAL, 0 to 1: of the planned velocities
  std::string release = "operator_release";  // BOOL: arms that are too near may move apart
};

struct ArmsProgramOptions {
  std::int64_t interval_us = 10'000;
  double min_distance_m = 0.05;  // of the interlock, at most; see kLeastDistance_m
  // Set points are ahead of the path by what drives lag behind them: a time, up to the speed at which a drive
  // would brake from there within it, more beyond. Joints that lag differently would leave the path. 0: not.
  double lead_s = 0.025;
  std::array<double, 7> brake_rad_s2{8, 8, 9.6, 9.6, 16, 16, 16};
  // Most that a joint may be off its set point, besides what it moves between two scans: MaxFollowingError.
  double following_rad = 0.004;
  double start_rad = 0.02;                       // most that an arm may be off the schedule's beginning
  double squeeze_m = 0.004;                      // how far below a thing's width fingers are told to close
  double width_m = 0.003;                        // most that a held thing's width may be off
  std::chrono::milliseconds grip_after{100};     // it has to be held for so long
  std::chrono::milliseconds grip_within{1'500};  // else it was missed
  std::chrono::milliseconds lost_after{60};
  std::chrono::milliseconds fingers_within{2'000};  // they come to their opening
  std::chrono::milliseconds camera_every{0};        // of Follow, Halt; 0: no pictures
  std::chrono::milliseconds picture_within{1'000};  // then another one is taken
  std::size_t reports = 3;                          // of Observe, and how many are kept
  bool standing_enabled = false;                    // of Observe: drives stay on, brakes off
  // Errors of the groups are reset as the program begins, by blocks of this number, another one in each
  // program of a run; 0: they are not.
  std::uint32_t reset = 0;
  std::chrono::milliseconds news_every{500};  // to whoever follows the program
};

// Arms that come nearer than this in their plan cannot be told from arms that touch.
inline constexpr double kLeastDistance_m = 0.01;

struct ArmsProgramInput {
  ArmsProgramKind kind = ArmsProgramKind::Follow;
  const scene::RobotCell* cell = nullptr;
  const schedule::CellSchedule* schedule = nullptr;  // not of Observe
};

struct ProgramSize {
  std::size_t paths = 0, points = 0, rows = 0, most_rows = 0;
  std::size_t data_bytes = 0;  // of way-points and rows in the controller
};

struct ArmsProgram {
  graphic::Project project;
  std::vector<ArmsStep> steps;  // of all charts, chart by chart, in the charts' order
  ArmsVariables variables;
  double min_distance_m = 0.0;  // that the interlock goes by
  ProgramSize size;
};

// G0301: a terminal is missing, or not as many arms as the cell has; G0302: a figure without sense; G0303:
// the plan brings the arms nearer to each other than kLeastDistance_m; G0304: an angle or opening that
// terminals cannot say, a way-point beyond the robot's limits; G0305: data that is larger than a program may
// be.
[[nodiscard]] result::Result<ArmsProgram> arms_program(const ArmsProgramInput& input,
                                                       const CellTerminals& terminals,
                                                       const ArmsProgramOptions& options = {});

}  // namespace stepwright::tamp::program
