#pragma once

// The schedule of one connection: which of its units has the next turn, and what answers and silences change
// about that. It knows neither a clock nor a line; whoever asks the units tells it the instants.
//
// Of what is due the oldest comes first; writes and reads alternate where both are. Units that do not answer
// are tried again one at a time and more and more rarely, so that their timeouts take at most a quarter of
// the line's time at first and next to nothing later. When nobody answers, nobody is spared; who answers
// first then wakes the others.
//
// Threads: the poller's.
//
//   const PollSchedule::Job job = schedule.next(now);  // Read: the next group of schedule.units()[job.unit]
//   schedule.answered(job.unit, now);                  // or silent(job.unit, sent, now)
//   schedule.ended(job.turn);

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/modbus/client/poll/unit.h"
#include "runtime/modbus/client/settings.h"

namespace stepwright::modbus::client {

class PollSchedule {
 public:
  using Clock = std::chrono::steady_clock;

  enum class Turn : std::uint8_t { Wait, Read, Write, Probe };
  struct Job {
    Turn turn = Turn::Wait;
    std::size_t unit = 0;
    Clock::time_point at = Clock::time_point::max();  // since when it is due, or how long to wait
  };

  // Effect of a request without an answer.
  struct Silence {
    bool dead = false;           // the unit counts as dead
    bool of_connection = false;  // the connection may carry nothing any more
  };

  // The devices must outlive it. `serial`: nothing says to which request an answer belongs, and silence says
  // nothing about the connection.
  PollSchedule(const std::vector<Device>& devices, Clock::time_point start, bool serial);

  std::vector<Unit>& units() { return units_; }

  // The turn at `now`, which begins with it, or until when there is none.
  Job next(Clock::time_point now);
  // That turn is over, on a connection that still holds.
  void ended(Turn turn) { wrote_last_ = turn == Turn::Write; }

  // The unit has answered, if only to refuse.
  void answered(std::size_t unit, Clock::time_point now);
  // The request that was sent to it at `sent` had no answer.
  Silence silent(std::size_t unit, Clock::time_point sent, Clock::time_point now);

  // Another connection is tried: what was silent on the one before says nothing.
  void connecting();
  // It is there, and nothing of the one before goes on.
  void begin_anew(Clock::time_point now);

 private:
  bool others_first(std::size_t unit, Clock::time_point now);
  bool others_awake(std::size_t unit) const;

  bool serial_;
  std::vector<Unit> units_;
  Clock::time_point probe_at_{};     // no dead unit is tried before
  std::vector<std::size_t> silent_;  // units since the newest answer of any
  Clock::time_point silence_at_{};   // the newest of any
  bool wrote_last_ = false;
};

}  // namespace stepwright::modbus::client
