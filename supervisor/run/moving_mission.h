#pragma once

// A mission of machines that move along a plan and come to rest before the next one: what vehicles, trains
// and arms do alike. From a cause to rest and to the next plan; holds of an operator, of an emergency stop
// and of what only people can see to; programs that relieve each other without a stop. A mission derives from
// it and says what moves, how it comes to rest and what is planned there.
//
//   class Cranes final : public MovingMission {
//     bool bring_to_rest() override;     // false: the run is over
//     bool plan_from_rest() override;    // up to the next program that runs
//     ...
//   };
//
// Thread rule: that of Mission.

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "supervisor/run/mission.h"
#include "supervisor/run/operator_hold.h"

namespace stepwright::run {

struct MovingOptions {
  int max_replans = 8;
  bool attended = true;              // somebody can see to what it cannot do; false: then the run ends
  std::chrono::seconds hold{3'600};  // of the scan clock: so long it waits for somebody
};

// What moves, in sentences.
struct MovingWords {
  std::string what;     // "the train": it is held, it may go on
  bool many = false;    // "the arms are held"
  std::string rests;    // "the train rests"
  std::string until;    // "it is resumed"
  std::string another;  // "another task": what it may be resumed with
  std::string stopped;  // "the program was stopped while the train was held"
};

class MovingMission : public Mission {
 protected:
  MovingMission(Controller& controller, MissionOptions options, MovingOptions moving, MovingWords words,
                Observer observer);

  virtual bool bring_to_rest() = 0;
  virtual bool plan_from_rest() = 0;
  // An image of what stands while it is held.
  virtual void see(std::span<const std::byte> image) = 0;
  // Nothing is asked for later by the cell's file.
  virtual bool none_to_come() const = 0;
  // It stands and is held from now on.
  virtual void held() {}
  // Why the plan after a hold is made.
  virtual Cause resumed();
  // Why a run ends that was held for `cause`.
  virtual std::string nobody_came(const Cause& cause, Phase phase) const;

  // Of a first run or another one: waits for its operator and for the runtime, and plans from rest.
  bool begin_from_rest(const std::string& waits);
  bool replan(const Cause& cause) final;
  // Nobody sees to anything, and nothing is asked for later.
  bool nobody_comes() const { return !moving_.attended && none_to_come(); }

  // At rest, while the program goes on scanning. Why the next plan is made; nothing if the run has ended.
  std::optional<Cause> hold(const Cause& cause, Phase phase, const std::string& message);
  // Holds until somebody lets it go on, and then for the next plan. False: the run is over.
  bool stay(const std::string& reason, IncidentKind kind);  // for what cannot be planned
  bool stay_held();                                         // for an operator who wants it
  bool stay_stopped();                                      // for an emergency stop

  // Of what was asked for and applied: a cause for another plan, or an incident that is decided.
  std::optional<Cause> decide_request(const Cause& cause, bool replans);
  // Takes a request of people. X0008: it `moves`, or holds what does, and nothing has begun.
  [[nodiscard]] result::Result<void> accept(bool moves, const std::function<void()>& add);

  // Brings a program to run: by an online change if one `runs`, else in its place. `taken`: before it drives.
  // False: the runtime is lost, or the run is over.
  bool relieve(bool runs, std::span<const std::byte> container, const std::function<void()>& taken);

  const MovingOptions moving_;
  OperatorHold hold_;  // or an emergency stop holds it, or what people have to see to

 private:
  bool go_on(const std::optional<Cause>& cause);

  const MovingWords words_;
};

}  // namespace stepwright::run
