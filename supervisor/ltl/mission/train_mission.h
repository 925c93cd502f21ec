#pragma once

// The mission of a tugger train: looks where the train stands, plans its task from there, follows the program
// by the states of the task's monitor, and plans anew from rest, and from what of the task is done, after
// whatever comes between: something that stands in the way, a trailer that is coupled or left, another task,
// a place out of service. What has no plan is no end: the train rests until people have seen to it. The
// monitor in the scan judges the run: its TRUE is the end.
//
// Threads: `run` belongs to one; requests may come from any. In simulated time the clock stands still while a
// plan is made. The same task, faults and requests at the same scan times give the same run.
//
//   TrainMission mission(*planning, controller, {.cell = "tugger"}, publish);
//   run::RunRecord record = mission.run();

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/ltl/mission/train_pictures.h"
#include "supervisor/ltl/mission/train_planning.h"
#include "supervisor/ltl/mission/train_reading.h"
#include "supervisor/ltl/mission/train_request.h"
#include "supervisor/run/due_requests.h"
#include "supervisor/run/moving_mission.h"

namespace stepwright::ltl {

struct TrainMissionOptions {
  std::string cell;
  int max_replans = 8;
  bool operator_starts = false;      // nothing moves before somebody starts the run
  bool barrier = true;               // simulated time waits for every decision
  bool attended = true;              // somebody can see to what the train cannot do; false: then the run ends
  std::chrono::seconds hold{3'600};  // of the scan clock: so long the train waits for somebody
  double scanner_m = 2.5;            // what stands in the way stands within this ahead
  std::filesystem::path journal{};   // for a restarted supervisor; empty: none is kept
  std::vector<TimedTrainRequest> requests{};  // in order of time
};

class TrainMission final : public run::MovingMission {
 public:
  TrainMission(const TrainPlanning& planning, run::Controller& controller, TrainMissionOptions options,
               Observer observer);

  // None: a task is a formula, which people write. It says so, with an example.
  std::string goal_form() const override;
  // At the next decision. X0003: a name that means nothing here; the codes of tasks.
  [[nodiscard]] result::Result<void> request(const TrainChange& change);

 private:
  // train_mission.cpp: from start to end.
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
  void take_task(TrainTask task);
  void draw() { show(pictures_.draw(task_, watched_, blocked_)); }

  // train_mission_follow.cpp: watching one plan.
  run::Decision judge_image(std::span<const std::byte> image) override;
  void note_progress();
  void leave_trailers(const TrainReading& before);
  run::Cause stopped_by_itself() const;
  Area in_the_way();
  bool stands_ahead() const;

  // train_mission_rest.cpp: to rest, and there.
  std::optional<run::Cause> hold_stopped() override;
  void held() override;
  void see(std::span<const std::byte> image) override;
  bool bring_to_rest() override;
  Rest await_train();

  // train_mission_plan.cpp: from rest to the next plan.
  bool plan_from_rest() override;
  bool launch(PreparedTrain prepared);
  void launch_record();
  bool install(const PreparedTrain& prepared);

  // train_mission_requests.cpp: what people ask for.
  result::Result<void> take(const run::Request& request) override;
  result::Result<void> request_start(const run::Request& request);
  std::optional<run::Cause> due(double time_s) override;
  bool apply(const GoalChange& goal, run::Cause& cause);
  bool apply(const BlockChange& block, run::Cause& cause);
  bool apply(const UnblockChange& unblock, run::Cause& cause);
  bool apply(const HoldChange& hold, run::Cause& cause);
  bool apply(const ResumeChange& resume, run::Cause& cause);

  const TrainPlanning& planning_;
  const TrainMissionOptions options_;

  TrainPictures pictures_;
  TrainTask task_;
  std::uint32_t state_ = 0;              // of its monitor, as last seen
  std::vector<Area> blocked_;            // what stands on the floor besides
  std::optional<PreparedTrain> driven_;  // the plan
  std::vector<TrainStep> steps_;         // of the program that runs: plan, halt or look
  std::string watched_;                  // the task of that program
  std::optional<TrainReader> reader_;    // of it, too
  TrainReading reading_;                 // the newest
  std::uint32_t resets_ = 0;             // so many programs have reset an error
  int blocks_ = 0;                       // so many things have stood in the way
  bool changed_ = false;                 // since the journal was written
  bool ran_ = false;                     // this is not the first run

  run::DueRequests<TimedTrainRequest> requests_;
};

}  // namespace stepwright::ltl
