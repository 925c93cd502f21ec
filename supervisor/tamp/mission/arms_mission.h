#pragma once

// The mission of two arms: looks at the cell, plans tasks and motions from where arms and things are, follows
// the program that does them, looks again whether the order is done. What comes between is an incident: a
// thing that slips or falls, one that is not where it was, arms too near to each other, another order. Then
// the arms come to rest on their paths, the camera looks, and a new plan begins there, with what hands hold
// put down first. A drive that has tripped, or a joint that does not follow, ends the run in the safe state,
// unless the camera shows what the arm has met: then it goes back by the way that it came, and a plan goes
// around, as for what is put into the way before an arm meets it. A thing that fails again and again ends the
// run, too. An emergency stop holds.
//
// Threads: `run` belongs to one; requests may come from any. In simulated time the clock stands still while a
// plan is made. The same order, faults and requests at the same scan times give the same run.
//
//   ArmsMission mission(*planning, controller, {.cell = "robot_cell"}, publish);
//   run::RunRecord record = mission.run();

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/run/due_requests.h"
#include "supervisor/run/moving_mission.h"
#include "supervisor/run/what_if_thread.h"
#include "supervisor/tamp/mission/arms_outlook.h"
#include "supervisor/tamp/mission/arms_planning.h"
#include "supervisor/tamp/mission/arms_reading.h"
#include "supervisor/tamp/mission/arms_request.h"
#include "supervisor/tamp/mission/observed_state.h"

namespace stepwright::tamp::mission {

struct ArmsMissionOptions {
  std::string cell;
  int max_replans = 12;
  int retries = 3;                   // of one thing that fails; once more is the end
  bool operator_starts = false;      // nothing moves before somebody starts the run
  bool barrier = true;               // simulated time waits for every decision
  bool attended = true;              // somebody can see to what the arms cannot do; false: then the run ends
  std::chrono::seconds hold{3'600};  // of the scan clock: so long the arms wait for somebody
  std::filesystem::path journal{};   // for a restarted supervisor; empty: none is kept
  std::vector<TimedArmsRequest> requests{};  // in order of time
};

class ArmsMission final : public run::MovingMission {
 public:
  ArmsMission(const ArmsPlanning& planning, run::Controller& controller, ArmsMissionOptions options,
              Observer observer);

  // Things and places, and the orders of the cell's file.
  std::string goal_form() const override;
  std::optional<std::string> new_outlook() override;
  // At the next decision. The codes of orders.
  [[nodiscard]] result::Result<void> request(const ArmsChange& change);

 private:
  enum class Kind : std::uint8_t { Look, Follow, Halt };  // of the program that runs
  // Of an arm's drives.
  struct Fault {
    std::size_t arm = 0;
    int joint = 0;         // that does not follow, from 1; 0: a drive has tripped
    double at_rad = 0.0;   // where it was then
    double off_rad = 0.0;  // and how far from its set point
  };
  // Why the arms were stopped, and whose retries that uses up.
  struct Surprise {
    run::Cause cause;
    std::string about;             // a thing, or an arm's fingers
    bool ends = false;             // nothing that a plan could mend
    std::optional<Fault> fault{};  // what the arm may have met is looked for
  };

  // arms_mission.cpp: from start to end.
  bool begin() override;
  bool drives() const override { return reader_.has_value(); }
  bool begins_again() const override { return true; }
  void forget_requests() override { requests_.forget_asked(); }
  bool none_to_come() const override { return requests_.none_to_come(); }
  std::optional<bool> resume();
  void forget_run();
  bool recover_runtime() override;
  bool finish() override;
  void publish(bool now) override;
  void write_journal() const;
  void take_order(ArmsOrder order);

  // arms_mission_pictures.cpp: what the page draws.
  void show_plan();
  void show_look(const program::ArmsProgram* looking);

  // arms_mission_follow.cpp: watching one plan.
  run::Decision judge_image(std::span<const std::byte> image) override;
  void see(std::span<const std::byte> image) override;
  void note_progress();
  bool take_report(std::span<const std::byte> image);
  std::optional<std::string> moved_thing() const;
  std::vector<std::optional<scene::Pose>> expected() const;
  const schedule::ScheduledStep* step_of(std::size_t arm) const;
  int held_by(std::size_t arm) const;

  // arms_mission_blocked.cpp: what stands in the way of the arms.
  std::optional<Seen> new_obstacle() const;
  std::optional<Seen> met_by(std::size_t arm) const;
  bool judge_fault();
  run::Cause cause_of(const Surprise& fault) const;
  void note_cause(const run::Cause& cause);
  std::optional<PreparedArms> retreat() const;
  std::string obstacles() const;
  std::vector<motion::JointPath> ways_back() const;
  motion::JointPath way_back(std::size_t arm) const;

  // arms_surprise.cpp: what has stopped the arms.
  Surprise surprise() const;
  Surprise drive_fault(std::size_t arm, const std::string& who) const;
  std::optional<Surprise> short_of_end() const;
  run::Decision answer(Surprise what);

  // arms_mission_rest.cpp: to rest, and there.
  std::optional<run::Cause> hold_stopped() override;
  bool bring_to_rest() override;
  bool look();
  bool picture();
  Rest await(bool (*there)(const ArmsReading&), double within_s, const std::string& late,
             run::IncidentKind kind);

  // arms_mission_plan.cpp: from rest to the next plan.
  bool plan_from_rest() override;
  bool look_at_fault();
  bool at_home() const;
  bool judge_end();
  bool plan_because(const run::Cause& cause);
  bool plan_order();
  bool launch(PreparedArms prepared, const std::string& message);
  void launch_record();
  bool install(const PreparedArms& prepared, Kind kind);

  // arms_mission_what_if.cpp: plans for other orders, which nobody drives.
  ArmsOutlook outlook() const;
  void note_outlook();
  [[nodiscard]] result::Result<void> ask_what_if(const std::string& id, std::string goal);
  std::string sketch(const ArmsOrder& order, const ArmsOutlook& from, const std::atomic<bool>& cancel) const;

  // arms_mission_requests.cpp: what people ask for.
  result::Result<void> take(const run::Request& request) override;
  result::Result<void> request_start(const run::Request& request);
  result::Result<void> request_what_if(const run::Request& request);
  std::optional<run::Cause> due(double time_s) override;
  bool apply(const GoalChange& goal, run::Cause& cause);
  bool apply(const HoldChange& hold, run::Cause& cause);
  bool apply(const ResumeChange& resume, run::Cause& cause);

  const ArmsPlanning& planning_;
  const ArmsMissionOptions options_;

  ArmsOrder order_;
  std::vector<scene::Pose> believed_;  // of each thing
  std::vector<int> held_;              // the thing that each arm holds; -1: nothing
  Observed observed_;                  // at the newest look
  Sight sight_;                        // likewise
  std::map<std::string, int> tries_;   // that failed
  std::uint32_t looks_ = 0;            // programs that have looked

  Kind kind_ = Kind::Look;
  std::optional<PreparedArms> driven_;  // the plan; none where a restarted supervisor does not know it
  std::optional<ArmsReader> reader_;    // of the program that runs
  ArmsReading reading_;                 // the newest
  std::vector<Report> newest_;          // while arms work, the last two reports
  std::vector<double> came_;            // progress of each arm in the plan that was driven last
  std::optional<Surprise> fault_;       // of a drive, until the camera has looked at what is there
  std::optional<std::size_t> met_;      // the arm that has met something, until it has gone back
  int seen_reports_ = 0;
  bool changed_ = false;  // since the journal was written
  bool ran_ = false;      // this is not the first run

  std::mutex outlook_mutex_;
  ArmsOutlook outlook_;             // guarded by the mutex, as the next two
  bool outlook_is_new_ = false;     // nobody has fetched it yet
  std::uint64_t told_what_if_ = 0;  // revision of the answer that was told last
  run::DueRequests<TimedArmsRequest> requests_;
  run::WhatIfThread what_if_;  // last: it plans with the above
};

}  // namespace stepwright::tamp::mission
