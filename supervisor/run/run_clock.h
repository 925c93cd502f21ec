#pragma once

// The clock of a run: that of the scan, which goes on over restarts of the runtime. A restarted runtime
// counts from zero, which shows in the incarnation of its process and in nothing else: a late message has an
// older time of the same process.
//
// Threads: one.
//
//   RunClock clock;
//   clock.see(event.incarnation, event.time_ns);
//   record.finished_s = clock.now_s();

#include <cstdint>

namespace stepwright::run {

class RunClock {
 public:
  // As a journal keeps it.
  struct State {
    double now_s = 0.0;
    double offset_s = 0.0;          // time of the run - scan clock of the process
    std::uint64_t incarnation = 0;  // of that process; 0: not known, as of journals of earlier versions
  };

  RunClock() = default;
  explicit RunClock(const State& state) : state_(state) {}

  // Takes note of a time of that process. The run's clock never goes back.
  void see(std::uint64_t incarnation, std::int64_t time_ns);
  // The run's time at that instant, without taking note of it.
  double at(std::uint64_t incarnation, std::int64_t time_ns) const;

  double now_s() const { return state_.now_s; }
  const State& state() const { return state_; }

 private:
  double offset_of(std::uint64_t incarnation, double scan_s) const;

  State state_;
};

}  // namespace stepwright::run
