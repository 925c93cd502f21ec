#pragma once

// One slave of a connection as its poller sees it: when which group is due, what is to be written, and
// whether it answers at all. A unit that does not answer is left alone for a while, and for longer each time,
// so that the others of its line keep their periods. Threads: the poller's. Instants are those of the steady
// clock.

#include <chrono>
#include <cstdint>
#include <vector>

#include "runtime/modbus/client/poll/read_plan.h"
#include "runtime/modbus/client/poll/write_plan.h"
#include "runtime/modbus/client/settings.h"

namespace stepwright::modbus::client {

struct GroupPoll {
  std::chrono::milliseconds period;
  std::uint32_t first_input = 0;  // of the device's inputs
  std::vector<Tag> inputs;
  std::vector<ReadRequest> requests;  // tags as indices of the device's inputs
  std::chrono::steady_clock::time_point due;
  std::chrono::steady_clock::time_point began{};   // its newest turn
  std::chrono::steady_clock::time_point before{};  // the turn before that
  std::size_t next = 0;  // request of the turn under way: a connection that is lost does not begin it anew

  // After a turn: the next one on the grid. Returns how many were missed.
  std::uint64_t advance(std::chrono::steady_clock::time_point now);
};

class Unit {
 public:
  using Clock = std::chrono::steady_clock;

  // The device must outlive it.
  // `rests`: nothing says to which request an answer of it belongs, as on a serial line.
  Unit(const Device& device, Clock::time_point start, bool rests = false);

  const Device& device() const { return *device_; }
  std::vector<GroupPoll>& groups() { return groups_; }
  WritePlan& writes() { return writes_; }

  // Behind a new connection: requests as they were planned, nothing acknowledged.
  void begin_anew();

  void answered();
  // True if it counts as dead from now on. `others_answer`: there is somebody whom its next try would delay.
  bool silent(Clock::time_point now, bool others_answer);
  bool asleep() const { return asleep_; }
  // It was silent, and is tried again before it counts as dead.
  bool doubtful() const { return !asleep_ && silences_ > 0; }
  Clock::time_point wakes_at() const { return wakes_at_; }
  // Not to be asked before: the answer to a request that was given up may still come, for as long again as
  // it was waited for.
  Clock::time_point rests_until() const { return rests_until_; }
  // A dead one is worth a try at `at`, and the pauses begin anew: what kept it silent may be over.
  void hope(Clock::time_point at);

  // When it was last asked for something.
  void begins(Clock::time_point now) { asked_at_ = now; }
  Clock::time_point asked_at() const { return asked_at_; }

  // The group that is due next; null without inputs.
  GroupPoll* next_group();

 private:
  void plan();

  const Device* device_;
  bool rests_;
  std::vector<GroupPoll> groups_;
  WritePlan writes_;
  int silences_ = 0;  // in a row
  bool asleep_ = false;
  std::chrono::milliseconds pause_{0};  // before the next try of a dead one
  Clock::time_point wakes_at_{};
  Clock::time_point asked_at_{};
  Clock::time_point rests_until_{};
};

}  // namespace stepwright::modbus::client
