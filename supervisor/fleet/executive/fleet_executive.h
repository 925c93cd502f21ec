#pragma once

// The executive of a fleet: plans a problem's loads, downloads the missions as one program, follows vehicles
// through their polygons, gives everybody new times when one is late, and plans anew for what new times do
// not mend: a vehicle that has stopped or come back, a blocked place, another order. Whatever cannot be
// mended ends in the safe state of the outputs, with a report. An emergency stop holds the fleet until
// somebody lets it go on, and so does an operator who asks for it (then all come to rest first); then
// everybody is planned for anew from where he stands. What cannot be done as things are is no end either: all
// rest until people have seen to it.
//
// Where an operator starts runs the first plan is shown and waits, and nothing is downloaded before. An order
// for which there is no plan is refused then; where a blocked place leaves none, that is waited for as well.
//
// A new plan begins from rest: everybody drives on as far as he is permitted already and needs to brake
// (halt_plan.h), which always can be done without asking anybody; then one plan for all that remains takes
// over by an online change (ADR 9 says why). The missions run in the scan without this.
//
// Threads: `run` belongs to one; requests may come from any. In simulated time the clock stands still while a
// decision is made. The same problem, faults and requests at the same scan times give the same run.
//
//   FleetExecutive executive(*service, controller, {.cell = "fleet"}, publish);
//   run::RunRecord record = executive.run();

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/fleet/executive/fleet_document.h"
#include "supervisor/fleet/executive/fleet_follow.h"
#include "supervisor/fleet/executive/fleet_planning.h"
#include "supervisor/fleet/executive/fleet_reading.h"
#include "supervisor/fleet/executive/fleet_request.h"
#include "supervisor/fleet/executive/track.h"
#include "supervisor/run/due_requests.h"
#include "supervisor/run/moving_mission.h"

namespace stepwright::fleet {

struct FleetExecutiveOptions {
  std::string cell;
  int max_replans = 8;
  bool operator_starts = false;           // the first plan waits for request_start; nothing moves before it
  bool barrier = true;                    // simulated time waits for every decision
  std::chrono::milliseconds late{3'000};  // more is a delay
  // Of the scan clock: so long an emergency stop or an operator holds the fleet until somebody lets it go on.
  std::chrono::seconds hold{3'600};
  bool attended = true;  // somebody can see to what the fleet cannot do; false: then the run ends
  // Of wall time between two documents that only tell of progress: they are large.
  std::chrono::milliseconds between_documents{500};
  std::filesystem::path journal;       // for a restarted supervisor; empty: none is kept
  std::vector<TimedRequest> requests;  // in order of time
};

class FleetExecutive final : public run::MovingMission {
 public:
  FleetExecutive(FleetPlanning& planning, run::Controller& controller, FleetExecutiveOptions options,
                 Observer observer);

  // X0008: nothing waits for a start, there is no plan, or no runtime answers.
  [[nodiscard]] result::Result<void> request_start();
  // At the next decision. Fails at once where the request cannot be meant (X0003), or not before the start
  // (X0008).
  [[nodiscard]] result::Result<void> request(const FleetChange& change);

  std::string goal_form() const override;

 private:
  // fleet_executive_requests.cpp: what people ask for.
  [[nodiscard]] result::Result<void> take(const run::Request& request) override;

  // fleet_executive_start.cpp: the first plan.
  bool start_afresh();
  bool give_up_planless(const FleetOutcome& outcome);
  void refuse_orders(LedgerState planned, const std::string& reason);
  Wish stay_ready(const FleetOutcome& outcome, const FleetRequest& request);
  Wish stay_planless(const std::string& reason);
  Wish await_people(Stage stage, const std::string& message);
  bool planless() const { return is(Stage::Planless); }

  // fleet_executive.cpp: from start to end.
  bool begin() override;
  bool drives() const override { return reader_.has_value(); }
  bool resume();
  bool resume_plan(FleetOutcome outcome, const FleetRequest& request);
  void write_journal();
  std::optional<std::string> carrier() const;
  bool recover_runtime() override;
  bool shut_in(std::uint32_t vehicle) const;
  bool has_more_room() const;
  bool finish() override;
  std::vector<std::string> missed() const;
  void note_goals();
  void publish(bool now) override;
  void renew_document();

  // fleet_executive_follow.cpp: watching one plan.
  run::Decision judge_image(std::span<const std::byte> image) override;
  run::Decision stopped(const host::StepEvent& event) override;
  void note(const FollowNews& news);
  void note_stop(const StopMade& stop, bool begun);
  void note_delay(const Delay& delay);
  std::optional<run::Cause> due(double time_s) override;
  // Apply one kind of request each; true if it takes another plan.
  bool apply(const OrderChange& order, run::Cause& cause);
  bool apply(const BlockChange& block, run::Cause& cause);
  bool apply(const UnblockChange& unblock, run::Cause& cause);
  bool apply(const ReturnChange& back, run::Cause& cause);
  bool apply(const HoldChange& hold, run::Cause& cause);
  bool apply(const ResumeChange& resume, run::Cause& cause);
  bool crosses(const geometry::ConvexPolygon& area) const;
  run::Cause lose(const std::vector<std::uint32_t>& errors, const FleetReading& reading,
                  const std::vector<double>& begun_m);
  std::chrono::milliseconds plan_clock() const;   // since the plan's time zero
  std::chrono::milliseconds first_clock() const;  // since the first plan's
  std::size_t action_of(const StopMade& stop) const;

  // fleet_executive_rest.cpp: to rest, between two plans and after an emergency stop.
  std::optional<run::Cause> hold_stopped() override;
  std::string nobody_came(const run::Cause& cause, run::Phase phase) const override;
  bool none_to_come() const override { return requests_.none_to_come(); }
  void see(std::span<const std::byte> image) override;
  run::Cause resumed() override;
  bool bring_to_rest() override;
  Rest await_fleet(const PreparedFleet& halt, const std::vector<double>& begun_m);
  bool all_rest(const PreparedFleet& halt) const;
  void watch_errors(const std::vector<double>& begun_m);
  void receive_returned(bool seen_anew);
  void track(const std::vector<double>& begun_m);
  ErrorReset take_resets();

  // fleet_executive_replan.cpp: from a cause to the next plan.
  FleetRequest next_request();
  NewStart start_of(std::uint32_t vehicle, const OccupancyGrid& map) const;
  bool plan_from_rest() override;
  bool relax(const FleetOutcome& outcome);
  void launch_record(const FleetOutcome& outcome);
  bool launch(FleetOutcome outcome, const FleetRequest& request);
  void follow_plan(FleetOutcome outcome, const FleetRequest& request);
  bool install(const PreparedFleet& prepared);
  void add_evidence(std::string sentence);

  FleetPlanning& planning_;
  const FleetExecutiveOptions options_;

  FleetLedger ledger_;
  std::optional<FleetFollow> follow_;  // of the plan that is driven
  std::optional<PreparedFleet> plan_;  // that one
  std::string plan_document_;          // of it: what the document shows as long as it is driven
  std::optional<FleetReader> reader_;  // of the program that runs: plan or halt
  FleetReading reading_;               // the newest
  std::vector<Track> tracks_;          // by vehicle: the last way, and where on it the vehicle stood
  std::vector<std::optional<Standing>> standing_;   // by vehicle: lost ones
  std::vector<std::optional<Standing>> returning_;  // by vehicle: where one stood that is to come back
  std::vector<std::chrono::milliseconds> begun_;    // by vehicle: its last stop, of the first plan's clock
  std::vector<bool> resets_;                        // by vehicle: with the next program
  std::vector<bool> reset_running_;                 // with the one that brings the fleet to rest
  std::uint32_t reset_number_ = 0;
  std::vector<Blocked> blocked_;
  LedgerState planned_from_;  // of the plan: what the ledger said, and what was asked
  FleetRequest planned_as_;
  std::uint32_t revision_ = 0;
  double first_epoch_s_ = 0.0;  // of the first plan's time zero
  double epoch_s_ = 0.0;        // of this plan's
  bool changed_ = false;        // since the document was published
  bool ordered_ = false;        // since the first plan was shown
  std::chrono::steady_clock::time_point published_{};

  run::DueRequests<TimedRequest> requests_;
};

}  // namespace stepwright::fleet
