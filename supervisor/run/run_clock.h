#pragma once

// The clock of a run: that of the scan, which goes on over restarts of the runtime. A runtime that is started
// again counts from zero; by which process said a time, and by nothing else, that is known: news that come
// late, after newer ones, are older times of the same process.
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

  // The scan clock of that runtime process showed this. The run's clock never goes back.
  void see(std::uint64_t incarnation, std::int64_t time_ns);
  // What the run's clock shows then, without seeing it.
  double at(std::uint64_t incarnation, std::int64_t time_ns) const;

  double now_s() const { return state_.now_s; }
  const State& state() const { return state_; }

 private:
  double offset_of(std::uint64_t incarnation, double scan_s) const;

  State state_;
};

}  // namespace stepwright::run
