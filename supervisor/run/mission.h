#pragma once

// The life of a run, from its first plan to its goal or to the safe state of the outputs: waits for the
// runtime, brings programs to run on it, watches them event by event, keeps the record with its incidents,
// and has a new plan made after an incident. A kind of plan derives a class from this one, which decides how
// to plan, what to observe, what a deviation means and how the plant comes to rest
// (supervisor/doc/adding_a_planner.md).
//
//   class Trains final : public Mission {
//     bool begin() override { plan(); return await_runtime() && launch(); }
//     Decision judge_image(std::span<const std::byte> image) override { ... }
//     ...
//   };
//   Trains trains(controller, {.cell = "yard"}, publish);
//   RunRecord record = trains.run();
//   while (trains.wait_start(1s)) record = trains.run();   // another one, where missions begin again
//
// Functions that return false mean: the run is over, and its phase says how (Done, Safe).
//
// Threads: `run` belongs to one thread; the request functions may be called from any.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <span>
#include <string>

#include "runtime/ground/result/result.h"
#include "supervisor/run/cause.h"
#include "supervisor/run/controller.h"
#include "supervisor/run/picture.h"
#include "supervisor/run/request.h"
#include "supervisor/run/run_clock.h"
#include "supervisor/run/run_record.h"
#include "supervisor/run/tag_watch.h"

namespace stepwright::run {

struct MissionOptions {
  std::string cell;
  bool barrier = true;           // simulated time waits for every decision
  bool operator_starts = false;  // the first plan waits for a start; nothing moves before it
};

class Mission {
 public:
  using Observer = std::function<void(const RunRecord&)>;  // after changes, from the thread of `run`

  // The controller must outlive this.
  Mission(Controller& controller, MissionOptions options, Observer observer);
  virtual ~Mission() = default;
  Mission(const Mission&) = delete;
  Mission& operator=(const Mission&) = delete;

  // Before the first run: a tag that becomes TRUE is an incident, for which a new plan is made.
  void watch(std::vector<WatchedTag> tags) { watch_ = TagWatch(std::move(tags)); }
  // Before the first run: nobody waits for another start once it is over; then a start is refused (X0008).
  void only_once() { once_ = true; }
  // Until the goal is reached (Phase::Done) or the outputs are safe (Phase::Safe).
  RunRecord run();
  // Stops the plant safely at the next decision and ends the run.
  void request_abort() { abort_ = true; }
  // A request of people: "abort", or a word of the mission's own. X0003 or X0005 where it cannot be meant,
  // X0008 where not now.
  [[nodiscard]] result::Result<void> obey(const Request& request);

  // Whether `run` has ended and nobody has started another one.
  bool over() const;
  // Waits until somebody wants another run; false after `timeout`. The next call of `run` is that one.
  bool wait_start(std::chrono::milliseconds timeout);

  // What a page makes a goal of (supervisor/doc/goals.md), JSON: the same for as long as this lives.
  virtual std::string goal_form() const;
  // Where a plan would begin and what a what-if has come to, JSON; nothing if that is as it was at the last
  // call. One thread at a time.
  virtual std::optional<std::string> new_outlook() { return std::nullopt; }
  // What the page draws of the plan (picture.h), JSON; nothing if that is as it was at the last call. One
  // thread at a time.
  std::optional<std::string> new_pictures();

 protected:
  enum class Stage : std::uint8_t {
    Running,
    Ready,     // a plan waits for an operator
    Planless,  // there is none that could be started
    Over,
  };
  enum class Wish : std::uint8_t { Start, OtherPlan, Abort };
  // How a wait for rest has ended.
  enum class Rest : std::uint8_t {
    Reached,  // at an event that is not acknowledged (rested_at_): the clock stands still
    Error,    // something that people have to see to; the clock goes on
    Lost,     // the runtime has gone, or has lost the program
    Ended,    // the run is over
  };

  // Functions of a mission. From a journal or afresh, up to a program that runs:
  virtual bool begin() = 0;
  // Judges the image of the running program at an event; the clock has seen it.
  virtual Decision judge_image(std::span<const std::byte> image) = 0;
  // From a cause to the next program that runs.
  virtual bool replan(const Cause& cause) = 0;
  // The plan has ended: the goal is reached, or there is more to do.
  virtual bool finish() = 0;
  // A runtime that was lost: it goes on with the plan, or another one is made.
  virtual bool recover_runtime() = 0;
  // Tells the observer and the journal. `now`: at once, not only later.
  virtual void publish(bool now) = 0;
  // Whether a program was brought to the runtime, which has to be stopped at the end.
  virtual bool drives() const = 0;

  // And what most do alike. Requests of people, by the mission's own words.
  [[nodiscard]] virtual result::Result<void> take(const Request& request);
  // Whether another run can begin after one that is over: from where the plant is then.
  virtual bool begins_again() const { return false; }
  // What was asked of a run that is over, and not yet taken, is not meant for the next one.
  virtual void forget_requests() {}
  // Wants of people that come before the next event.
  virtual std::optional<Cause> wish() { return std::nullopt; }
  // Wants that are due by the scan clock, people's among them.
  virtual std::optional<Cause> due(double) { return std::nullopt; }
  // The runtime has stopped, though it was to go on.
  virtual Decision stopped(const host::StepEvent& event);
  // An emergency stop: why is the next plan made? Nothing: the run is over.
  virtual std::optional<Cause> hold_stopped() { return std::nullopt; }
  // An incident that is opened; of more than its cause.
  virtual void opened(Incident&) {}

  // The record.
  void set_phase(Phase phase, std::string message);
  // In place of the pictures that were shown before.
  void show(const Pictures& pictures);
  void open_incident(const Cause& cause);
  // Of the incident that is open: how long that took is measured.
  void decide(Response response);
  void work_begins();
  void work_pauses();  // while the plant is looked at, say
  bool give_up(const std::string& reason, IncidentKind kind = IncidentKind::ProgramFault,
               result::ExitCode exit = result::ExitCode::RuntimeFault);
  bool give_up(const Cause& cause);
  bool give_up(const std::string& what, const result::Diagnostics& diagnostics,
               IncidentKind kind = IncidentKind::ProgramFault);
  bool give_up_aborted();

  // The runtime and its program. What brings one to run is false, too, if the runtime is lost (phase
  // unchanged).
  bool await_runtime();
  // Asked after a while without news.
  bool runtime_lost();
  // The runtime runs the program that was brought to it last, as far as the newest status tells.
  bool runs() const;
  // An online change that was accepted; the next event is its Changed.
  bool change(std::span<const std::byte> container);
  // In place of the running one, stopped.
  bool download(std::span<const std::byte> container);
  // Starts what was downloaded, up to its event.
  bool start();
  bool await_event(host::EventKind kind);

  // Has `install` bring a program to run, and again where the runtime was lost meanwhile and is back.
  bool bring_to_run(const std::function<bool()>& install);
  // Waits for a runtime that is not heard of; the phase is Waiting then. False: aborted.
  bool await_answer();
  // The same, as on a machine with much else to do: whether it has gone on with its program meanwhile, which
  // is an incident; the phase is the one of before then. False with the phase Safe: aborted.
  bool has_gone_on();
  // The runtime runs exactly this container.
  bool runs_program(std::span<const std::byte> container);
  // A plant at rest, while its program goes on scanning, and people see to something.
  struct Hold {
    std::optional<Cause> cause{};  // of an incident of its own; nothing: the one that is open
    Phase phase = Phase::Held;
    std::string message{};
    std::chrono::seconds most = std::chrono::seconds::max();  // of the scan clock
    // Why the run ends if the program is stopped or lost meanwhile; empty: that is evidence, and it holds on.
    std::string stopped{};
    std::string left{};  // why it ends if nobody comes
    std::function<bool()> holds{};
    std::function<void(std::span<const std::byte> image)> see{};  // may be empty, as the next one
    std::function<void(const Cause& cause)> asked{};              // what people ask for meanwhile
  };
  // Until it no longer holds; what people ask for meanwhile is taken (due). How long that was, in seconds of
  // the scan clock; nothing: the run is over.
  std::optional<double> hold_at_rest(const Hold& hold);
  // A plant that is brought to rest, or looked at, by the program that runs.
  struct Await {
    double within_s = std::numeric_limits<double>::infinity();  // of the scan clock
    std::string late{};                                         // why the run ends if it takes longer,
    IncidentKind late_kind = IncidentKind::Timeout;
    std::string stopped{};      // and if the program is stopped meanwhile,
    std::string rolled_back{};  // or the one before drives again; empty: ours counts as lost then
    // A runtime that was not heard of and has gone on is no longer lost.
    bool goes_on = true;
    // Reached, Error, or nothing: not yet.
    std::function<std::optional<Rest>(std::span<const std::byte> image)> see;
  };
  Rest await_rest(const Await& await);
  // The newest time that the runtime's picture of that program shows; at least `now_s`. A plant at rest
  // causes no events that would tell it.
  double shown_time(const std::optional<host::Snapshot>& snapshot, double now_s) const;

  // An empty record for another run; cell and clock go on.
  void begin_record();
  // From one run, or plan, to the next. A plan that waits for its operator:
  void enter(Stage stage);
  // Begins what waits, or another run. X0008: nothing waits, there is no plan, or no runtime answers. `also`
  // happens together with the start.
  [[nodiscard]] result::Result<void> accept_start(const std::function<void()>& also = {});
  // Shows the plan that waits, or that there is none (Planless), until somebody starts it or wants another
  // one (`cause`); a start may have come with that.
  Wish await_wish(Stage stage, std::string message, std::optional<Cause>& cause);
  // The same where the plan is made, or made again, behind the start. True at once where no operator starts
  // runs; false: aborted.
  bool await_operator(const std::string& message);
  // Somebody has asked for a start that has not begun; it begins, or it is refused.
  bool start_wanted() const;
  void begin_start();
  void forget_start();
  bool is(Stage stage) const;
  [[nodiscard]] result::Result<void> run_is_over() const;

  Controller& controller_;
  RunRecord record_;
  RunClock clock_;          // of the record
  std::string digest_;      // of the program that was brought to the runtime last
  bool confirmed_ = false;  // a status has said that the runtime has that program
  std::atomic<bool> abort_{false};
  mutable std::mutex requests_mutex_;  // of the stage and what goes with it
  Stage stage_ = Stage::Running;       // guarded by the mutex, as the next one
  bool start_ = false;                 // asked for and not yet begun
  std::condition_variable start_signal_;
  std::uint64_t rested_at_ = 0;  // the event at which the plant rested

  void tell() const {
    if (observer_) observer_(record_);
  }

 private:
  bool can_begin_again() const { return begins_again() && !once_; }
  Decision follow();
  Decision judge(const host::StepEvent& event);
  Decision trapped(const host::StepEvent& event);
  bool act_on(const Decision& decision);
  bool see_held(const host::StepEvent& event, const Hold& hold);
  bool note_stopped(const host::StepEvent& event);
  void brought(std::string digest);

  std::mutex pictures_mutex_;
  std::optional<std::string> pictures_;  // that nobody has fetched yet; guarded by the mutex

  const MissionOptions options_;
  const Observer observer_;
  TagWatch watch_;
  bool once_ = false;
  bool ended_ = false;     // this run has told its end, and somebody may have started another one since
  int silent_rounds_ = 0;  // without news and without that status
  std::optional<std::chrono::steady_clock::time_point> working_since_;  // on a decision
};

// The form of a mission whose goals no page can put together.
// `locations`: between which orders go, of a mission that has orders instead of goals.
std::string no_goal_form_json(const std::string& reason, const std::vector<std::string>& locations = {});

}  // namespace stepwright::run
