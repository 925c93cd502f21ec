#pragma once

// A plan of the fleet as a program that runs in the scan: one sequential function chart for each vehicle,
// whose transitions are the precedences of the schedule, paths and polygons as data, and the function blocks
// that drive (ladder/driver/library/vehicle*.st). supervisor/doc/fleet_program.md states the rules, ADR 8 the
// decision.
//
// A pure function; the result is a value. Lowering, compiling and drawing take `project` as any hand-written
// one.
//
//   auto program = fleet_program(plan, terminals_in_a_row(plan.missions.size()), {});
//   if (!program) std::cerr << to_string(program.error());
//   driver::compile({.texts = {}, .projects = {&program->project}});

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ladder/graphic/project.h"
#include "runtime/ground/result/result.h"
#include "supervisor/fleet/plan/fleet_plan.h"
#include "supervisor/fleet/program/terminals.h"
#include "supervisor/fleet/program/wait_places.h"

namespace stepwright::fleet {

// How the vehicles move, as far as the plan does not say it.
struct DriveData {
  double speed_up_m_s2 = 0.5;
  double brake_m_s2 = 0.6;       // planned with
  double hard_brake_m_s2 = 1.2;  // to keep to the plan
  double lateral_m_s2 = 0.8;     // of a curve, at most
  double lock_rate_rad_s = 0.5;
  double speed_lag_s = 0.3;  // of the drives, which set points make up for
  double lock_lag_s = 0.15;
};

// Vehicles whose errors are reset as the program begins.
struct ErrorReset {
  std::vector<bool> vehicles;  // by vehicle; empty: none
  // Another one in each program of a run: an online change carries a block by its name, and so what it knows.
  std::uint32_t number = 0;
};

struct ProgramOptions {
  std::int64_t interval_us = 20'000;
  DriveData drive;
  FleetMargins margins;
  double sample_m = 0.2;      // between samples of a path
  bool load_switches = true;  // a pick-up without a load on the forks is an error
  // A chart of its own changes its step so often: news for whoever follows the missions although no vehicle
  // takes a step. Zero: none.
  std::chrono::milliseconds news_every{0};
  // Counts the plans of a run. The program's clock begins anew with each, also after an online change.
  std::uint32_t revision = 1;
  ErrorReset reset = {};
};

// Kind of a step of a vehicle's chart.
enum class MissionStepKind : std::uint8_t { Start, Polygon, Stop, Failed, Done };
struct MissionStep {
  std::string name;
  MissionStepKind kind = MissionStepKind::Start;
  std::size_t polygon = 0;   // up to which the vehicle may drive, or in which it stands
  std::size_t stop = 0;      // of a Stop or Failed
  double permitted_m = 0.0;  // along the path
};

struct MissionProgram {
  std::string vehicle;             // as the plan names it
  std::string name;                // the same in names of variables
  std::string program;             // POU and instance of its chart
  std::vector<MissionStep> steps;  // in the order of the chart's
};

// Size of the program's data, which must fit the controller's memory.
struct ProgramFigures {
  std::size_t samples = 0;
  std::size_t planes = 0;
  std::size_t polygons = 0;
  std::size_t interlocks = 0;
  std::size_t table_bytes = 0;
};

// An upper bound of a temporal constraint, which the scan watches: `late_V` is true once it is missed, and
// `late_for_V` the constraint's index plus 1.
struct ProgramLimit {
  std::uint32_t constraint = 0;         // index into the plan's
  std::uint32_t vehicle = 0;            // V, whose part it is
  std::chrono::milliseconds within{0};  // since time zero or what the constraint counts from
};

struct FleetProgram {
  graphic::Project project;
  std::vector<MissionProgram> missions;  // in the plan's order
  ProgramFigures figures;
  std::vector<ProgramLimit> limits;
  result::Diagnostics warnings;  // F1106: temporal constraints that the program does not see to in full
};

// The program with that chart.
inline constexpr const char* kNewsProgram = "news";

// F1101: the plan is no schedule, or its parts do not belong together (F0201, F0202, F0502: data of a
// vehicle). F1102: two polygons overlap and no precedence orders them, so that a delay could let vehicles
// meet. F1103: vehicles would wait for each other for ever, because a polygon is too short to wait before it.
// F1104: too large for the data's types, or outside of what the terminals can say. F1105: a terminal that a
// vehicle needs is missing, or a figure has no physical sense.
[[nodiscard]] result::Result<FleetProgram> fleet_program(const FleetPlan& plan,
                                                         const FleetTerminals& terminals,
                                                         const ProgramOptions& options);

}  // namespace stepwright::fleet
