#pragma once

// Record of a run: every plan, every action with its planned and actual times, costs and levels, every replan
// with its cause. It is the one record behind the plan document that viewers see, the journal that a
// restarted supervisor reads, and the report.
//
// Plain values. Times are seconds of the runtime's scan clock; planned times count from the start of the
// episode.

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runtime/ground/result/exit_code.h"
#include "runtime/ground/result/result.h"
#include "supervisor/run/incident.h"
#include "supervisor/translate/progress.h"

namespace stepwright::run {

using translate::ActionState;

struct ActionRecord {
  std::string text;  // "(load v1 f1 level8)"
  std::string step;  // of the chart
  ActionState state = ActionState::Pending;
  double planned_start_s = 0.0;
  double planned_finish_s = 0.0;
  std::optional<double> started_s;
  std::optional<double> finished_s;
  // The value that the report follows (metric, or the configured transport cost) added by this action.
  double planned_cost = 0.0;
  std::optional<double> actual_cost;
  std::map<std::string, double> expected;  // observed fluents after the action, as planned
  std::map<std::string, double> observed;  // and as seen when it was done

  friend bool operator==(const ActionRecord&, const ActionRecord&) = default;
};

// One plan and its execution.
struct Episode {
  std::string digest;  // of the program that executes it
  double started_s = 0.0;
  double cost = 0.0;
  std::optional<double> bound;  // no plan can cost less; nothing if the search ended before it knew one
  bool proved_optimal = false;
  double first_plan_ms = 0.0;
  double optimal_plan_ms = 0.0;
  // Where it comes from: "planned", "kept", "repaired" or "replanned"; of so many actions that were left of
  // the plan before it so many were kept, and what the repair and the new plan beside it took.
  std::string origin = "planned";
  std::size_t kept = 0;
  std::size_t remaining = 0;
  double repair_ms = 0.0;
  double replan_ms = 0.0;
  double planned_makespan_s = 0.0;             // of the partial order, from the binding's nominal durations
  double planned_sequential_makespan_s = 0.0;  // of the same actions one after the other
  std::vector<ActionRecord> actions;

  friend bool operator==(const Episode&, const Episode&) = default;
};

struct Replan {
  double time_s = 0.0;
  std::string cause;
  std::string after_action;  // the last action that was done; empty at the start
  bool held = false;         // an operator held the run: no fault of the plan

  friend bool operator==(const Replan&, const Replan&) = default;
};

struct GoalRecord {
  std::string text;
  bool met = false;

  friend bool operator==(const GoalRecord&, const GoalRecord&) = default;
};

enum class Phase : std::uint8_t {
  Planning,
  Observing,
  Executing,
  Replanning,
  Ready,    // there is a plan; nothing moves until an operator starts it
  Waiting,  // for a runtime that is not there
  Holding,  // on the way to rest, because an operator wants it
  Held,     // at rest until an operator resumes or aborts the run
  Done,     // the goal is reached
  Safe,     // given up; the plant is in its safe state
};

struct RunRecord {
  std::string cell;
  Phase phase = Phase::Planning;
  std::string message;                             // a sentence for people
  result::ExitCode exit = result::ExitCode::Done;  // what the supervisor's command ends with
  std::vector<Episode> episodes;
  std::vector<Replan> replans;
  std::vector<Incident> incidents;  // what did not go as planned, and what was decided
  std::vector<GoalRecord> goal;
  std::map<std::string, double> expected;  // now
  std::map<std::string, double> observed;  // now
  std::map<std::string, double> tare;      // bias of each sensor in raw counts; empty until it is identified
  double started_s = 0.0;                  // first action of the first episode
  double finished_s = 0.0;                 // last action of the last episode
  // What only one kind of mission has, by a name of its own that no other part of the record has, as JSON.
  std::map<std::string, std::string> details{};

  friend bool operator==(const RunRecord&, const RunRecord&) = default;
};

// Of them those that count towards the most that a run may have.
std::size_t counted(const std::vector<Replan>& replans);

const char* to_string(ActionState state);
const char* to_string(Phase phase);

// JSON text; the format is specified in supervisor/doc/plan_document.md.
std::string to_json(const RunRecord& record);
[[nodiscard]] result::Result<RunRecord> record_from_json(const std::string& text, const std::string& file);

}  // namespace stepwright::run
