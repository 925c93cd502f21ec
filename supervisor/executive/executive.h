#pragma once

// The executive: takes a plan to its goal on a real controller. Looks at the plant, downloads the plan's
// program, follows it step by step, compares what it observes with what the plan expects, and replans from
// the observed state on a deviation, a timeout or a changed goal. Whatever it cannot mend ends in the safe
// state of the outputs with a report. An operator may hold the run: what the plan drives is switched off at
// once, the plant is brought to a known place and rests there; resumed, it is looked at and planned for anew.
//
//   Executive executive(service, controller, {.max_replans = 8}, publish);
//   RunRecord record = executive.run();
//   while (executive.wait_start(1s)) record = executive.run();   // another one, from where the plant is
//
// Another run begins with a look at the plant, with the goal that the start or the run before had.
//
// Its run begins at the problem's initial state or, if the journal tells of a plan that the controller still
// executes, where that stands.
//
// Threads: `run` belongs to one thread; every other function may be called from any. Plans are made in a
// thread of their own, while that of `run` watches plant and runtime: news that overtakes a planning cancels
// it, and it begins again from there.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/executive/classify.h"
#include "supervisor/executive/device_failures.h"
#include "supervisor/executive/drift_watch.h"
#include "supervisor/executive/goal_form.h"
#include "supervisor/executive/outlook.h"
#include "supervisor/executive/planning_job.h"
#include "supervisor/executive/planning_service.h"
#include "supervisor/executive/recurrence.h"
#include "supervisor/executive/rest_watch.h"
#include "supervisor/executive/what_if.h"
#include "supervisor/run/due_requests.h"
#include "supervisor/run/image_reader.h"
#include "supervisor/run/mission.h"
#include "supervisor/translate/estimate.h"
#include "supervisor/translate/progress.h"

namespace stepwright::executive {

struct Journal;

// Change of the goal from outside at a time of the scan clock: a client's new demand, or another goal.
struct GoalChange {
  double at_s = 0.0;
  std::string fluent;  // "(demand c1)"
  double value = 0.0;
  std::string goal{};  // PDDL; takes the place of the goal so far, and the fluent is ignored
};

struct ExecutiveOptions {
  std::string cell;
  int max_replans = 8;
  std::chrono::milliseconds settle{3'000};  // plant time over which sensors are averaged before a decision
  bool barrier = true;                      // simulated time waits for every decision
  bool operator_starts = false;             // the first plan waits for request_start; nothing moves before it
  bool believes_sensors = false;  // the first plan starts where they show the plant, whatever :init says
  std::filesystem::path journal;  // for a restarted supervisor; empty: none is kept
  std::vector<GoalChange> goal_changes;  // in order of time
  WhatIfOptions what_if{};               // of plans that are only looked at
};

class Executive final : public run::Mission {
 public:
  Executive(const PlanningService& planning, run::Controller& controller, ExecutiveOptions options,
            Observer observer);

  // Begins what waits for an operator, or another run after one that has ended; `goal` (PDDL) takes the place
  // of the goal so far unless it is empty. Refused while a run is under way or no runtime answers (X0008),
  // and as request_goal.
  [[nodiscard]] result::Result<void> request_start(const std::string& goal);
  // Brings the plant to rest at the next decision and keeps it there until the run is resumed or aborted,
  // over a restart of this supervisor too. Refused (X0008) while it is held, or is not, or waits for its
  // start.
  [[nodiscard]] result::Result<void> request_hold();
  [[nodiscard]] result::Result<void> request_resume();
  // Sets a fluent at the next decision and replans. An unknown fluent or one that the plant decides is
  // refused (X0003).
  [[nodiscard]] result::Result<void> request_change(const std::string& fluent, double value);
  // Puts another goal in place at the next decision, also while a plan is being made. Fails as a goal in a
  // file would (P0xxx).
  [[nodiscard]] result::Result<void> request_goal(const std::string& goal);

  // Where a plan for another goal would begin now, and which of its revisions that is.
  Outlook outlook() const;
  std::uint64_t outlook_revision() const;

  std::string goal_form() const override;
  std::optional<std::string> new_outlook() override;

 private:
  // executive_requests.cpp: what people ask for.
  [[nodiscard]] result::Result<void> take(const run::Request& request) override;
  bool begins_again() const override { return true; }
  void forget_requests() override;

  enum class Away : std::uint8_t { Runtime, Supervisor };  // who was not there for a while
  // executive.cpp: from start to end. Each returns false when the run is over.
  bool begin() override;
  bool drives() const override { return reader_.has_value(); }
  bool start_afresh(bool wanted);
  bool resume();
  bool stay_over(Journal&& journal);
  bool observe(bool locate);
  Rest observe_once(const PreparedPlan& observer);
  bool give_up_leap();
  bool launch();
  // Supervisor: this one has just begun, where another one has left its journal.
  bool recover_runtime(Away who);
  bool recover_runtime() override { return recover_runtime(Away::Runtime); }
  bool finish() override;
  void reach_goal();
  std::vector<std::string> missed() const;
  void note_goal();
  std::set<std::string> beside_goal() const;
  void publish(bool now) override;

  // executive_start.cpp: from one run to the next.
  model::NamedState first_state() const;
  bool stay_ready();
  bool begin_again();
  void forget_run();
  void renew_outlook();

  // executive_plan.cpp: incidents, and the plans that answer them.
  enum class Planned : std::uint8_t {
    Ready,  // into current_
    None,   // there is no plan: unplannable_ says why
    Again,  // the plant is not any more where the planning began
    Over,   // the run is
  };
  // Goal and fluents as set from outside.
  struct Asked {
    std::string goal;
    std::map<std::string, double> changed;
  };
  Planned plan_first();
  bool await_people();
  void refuse_change(run::Cause cause, Asked before);
  struct Unplannable {
    std::string reason;
    result::ExitCode exit = result::ExitCode::RuntimeFault;
  };
  bool replan(const run::Cause& cause) override;
  bool mend(const std::string& signature, const model::NamedState& tracked,
            const std::vector<model::GroundAction>& interrupted,
            const std::vector<model::GroundAction>& remaining);
  Planned plan_to_goal(const model::NamedState& tracked, const std::vector<model::GroundAction>& interrupted,
                       const std::vector<model::GroundAction>& remaining);
  Planned plan_watched(StartState start, const std::vector<model::GroundAction>& remaining);
  std::vector<translate::Difference> left_over() const;
  std::optional<Planned> overtaken(PlanningJob& job, StartState& start, RestWatch& rest, bool& again);
  void close_episode(std::string& last_done);
  std::vector<model::GroundAction> remaining_actions() const;
  void opened(run::Incident& incident) override;
  void note_failed_devices(const run::Cause& cause);
  bool give_up_planless();
  void overtake(std::string evidence);

  // executive_hold.cpp: at rest for as long as an operator wants it.
  static run::Cause held_by_operator();
  std::optional<run::Cause> wish() override;
  bool stay_held();

  // executive_install.cpp: bringing a program to run.
  enum class Kind : std::uint8_t { Observer, Plan };
  bool install(const PreparedPlan& prepared, Kind kind);
  bool read_program(const PreparedPlan& prepared, Kind kind);
  [[nodiscard]] result::Result<run::ImageReader> reader_of(const PreparedPlan& prepared, Kind kind) const;
  bool take_over(const PreparedPlan& prepared, Kind kind);
  bool download_and_start(const PreparedPlan& prepared, Kind kind);

  // executive_follow.cpp: watching one program.
  run::Decision judge_image(std::span<const std::byte> image) override;
  run::Decision judge_steps(std::span<const std::byte> image, double time_s);
  bool settled(const std::vector<bool>& active) const;
  void note_progress(const translate::Progress& progress, double time_s);
  void note_done(std::size_t action, double time_s);
  Situation situation(const translate::Progress& progress, const model::NamedState& expected,
                      double time_s) const;
  std::set<std::string> moving_atoms(const translate::Progress& progress) const;
  FailedAction failure_of(std::size_t action, double time_s) const;
  FailedAction failing(const model::GroundAction& action) const;
  FailedAction standstill_of(const run::Alarm& alarm) const;
  std::string watched_action(const translate::Monitor& monitor) const;
  void note_alarms(std::span<const std::byte> image);
  void note_told_alarms();
  void note_levels(const std::set<std::string>& moving);
  std::optional<run::Cause> due(double time_s) override;
  std::vector<model::GroundAction> begun_actions(bool resting) const;
  model::NamedState with_changes(model::NamedState state) const;

  const PlanningService& planning_;
  const ExecutiveOptions options_;

  PreparedPlan current_;                          // the plan that runs
  Unplannable unplannable_;                       // of the last planning that found none
  std::optional<run::ImageReader> alarm_reader_;  // of the plan's monitors
  std::size_t alarms_seen_ = 0;
  std::set<std::size_t> alarms_told_;               // monitors of the installed program
  std::vector<run::Alarm> alarms_;                  // of which no incident tells yet
  std::vector<translate::Difference> differences_;  // of the last situation, of what nothing moved
  std::map<std::string, double> left_;  // levels as they were when the running plan last let go of them
  DriftWatch drift_;
  DeviceFailures devices_;
  Recurrence recurrence_;
  std::set<std::string> just_changed_;          // by actions that ended at the last event
  std::vector<std::string> limited_;            // sensors at the end of their range at the last event
  std::vector<translate::Difference> earlier_;  // of the incidents so far
  std::optional<run::ImageReader> reader_;      // of the program that runs (the plan's or the observer's)
  bool unwatched_ = false;                      // steps may have come and gone since the last event
  translate::Tare tare_;
  std::map<std::string, double> means_;    // of the last observation, by variable
  translate::Estimate seen_;               // the last estimate
  translate::Progress progress_;           // of the current plan
  model::NamedState stuck_at_;             // the planner's state at the last replan
  std::string goal_;                       // PDDL; empty: the problem's
  std::map<std::string, double> changed_;  // fluents set from outside so far
  bool waits_ = false;                     // with a plan, for an operator

  bool begun_ = false;        // a run has
  bool another_run_ = false;  // so has one after it
  bool known_ = false;        // the sensors have their tare: the plant can be looked at in any state
  bool follows_ = false;      // progress_ and seen_ are of current_
  bool journalled_hold_ = false;

  std::atomic<bool> hold_{false};
  run::DueRequests<GoalChange> requests_;

  mutable std::mutex outlook_mutex_;
  Outlook outlook_;
  OutlookWriter outlook_writer_;
  WhatIf what_if_;
  // Revisions of outlook and what-if that viewers know.
  std::optional<std::pair<std::uint64_t, std::uint64_t>> told_;
};

}  // namespace stepwright::executive
