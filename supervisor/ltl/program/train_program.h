#pragma once

// A plan of a train as a program that runs in the scan: a chart whose steps are the progress of the task's
// automaton, the way as data for MC_DrivePath, and the task's monitor as a function block that judges what is
// really driven (supervisor/doc/train_program.md). The same without a way, which only observes, and one that
// comes to rest along the way that it is on.
//
// A pure function; the result is a value. Example:
//   const TrainWatch watch = train_watch(*formula, monitor->automaton);
//   auto program = train_program({.way = &way, .watch = &watch}, terminals, {});
//   driver::compile({.texts = {program->monitor}, .projects = {&program->project}});

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "ladder/graphic/project.h"
#include "runtime/ground/result/result.h"
#include "supervisor/ltl/automaton/automaton.h"
#include "supervisor/ltl/program/train_terminals.h"
#include "supervisor/ltl/program/train_way.h"

namespace stepwright::ltl {

// Names in the program that others read.
inline constexpr const char* kTaskChart = "progress";
inline constexpr const char* kTaskState = "task_state";
inline constexpr const char* kTaskVerdict = "task_verdict";

// Of the places' switches: legal and different from each other.
std::vector<std::string> place_names(const std::vector<std::string>& places);

enum class TrainProgramKind : std::uint8_t {
  Drive,    // along the way
  Halt,     // to rest on the way that an earlier program drives
  Observe,  // without a way: brakes on
};

enum class TrainStepKind : std::uint8_t { Start, Drive, Arrive, Blocked, Deviated, Halt, Done };
struct TrainStep {
  std::string name;
  TrainStepKind kind = TrainStepKind::Start;
  std::uint32_t state = 0;  // of the task's automaton, in which the train drives
  Label label = 0;          // Drive: what it reads at the end of the step
  double arc_m = 0.0;       // and where along the way
};

// What a program watches: one block type for each task, whose name an online change carries.
struct TrainWatch {
  Automaton automaton;  // that of monitor_automaton(); its initial state is where the program begins
  std::string text;     // the task
  std::string key;      // in names: the same for the same task
};
TrainWatch train_watch(const Automaton& automaton, const std::string& task);

struct TrainProgramOptions {
  std::int64_t interval_us = 10'000;
  TrainDrive drive;
  double fold_rad = 1.35;                          // of a hitch: the train stops before it folds
  std::chrono::milliseconds blocked_after{2'000};  // something stands in the way for so long
  std::chrono::milliseconds news_every{500};       // to whoever follows the program
  // So far along the way what the scanner sees is what the plan goes round already, slowly.
  double known_m = 0.0;
  // Errors are reset as the program begins, by a block of this number; 0: they are not.
  std::uint32_t reset = 0;
};

struct TrainProgramInput {
  TrainProgramKind kind = TrainProgramKind::Drive;
  const TrainModel* train = nullptr;
  std::vector<std::string> places;
  const TrainWay* way = nullptr;  // not of Observe
  const TrainWatch* watch = nullptr;
};

struct TrainProgram {
  graphic::Project project;
  std::string monitor;           // the text of the task's block
  std::vector<TrainStep> steps;  // of the chart, in its order
};

// L0501: a terminal is missing; L0502: what is outside of what terminals can say, or a figure without sense;
// L0031: the task's block would be too large.
[[nodiscard]] result::Result<TrainProgram> train_program(const TrainProgramInput& input,
                                                         const TrainTerminals& terminals,
                                                         const TrainProgramOptions& options = {});

}  // namespace stepwright::ltl
