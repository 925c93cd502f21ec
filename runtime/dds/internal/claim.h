#pragma once

// Claim of a supervisor on a runtime: the one that came first drives it, for as long as it is heard of.
// Others are refused with its name; when it is gone, the next one that asks has it.
//
// Threads: one at a time; who has more brings a mutex. No clock of its own.

#include <chrono>
#include <cstdint>
#include <string>

namespace stepwright::dds::internal {

class Claim {
 public:
  using Clock = std::chrono::steady_clock;

  // Longer than a heartbeat may be late (kHeartbeatLease), so that a claim does not end before its
  // liveliness.
  static constexpr std::chrono::milliseconds kLost{450};

  // Supervisor `client` asks for something: whether it has the claim, or has it from now on.
  bool admits(std::uint64_t client, Clock::time_point now);
  // Its heartbeat came. Claims what nobody holds: a supervisor is there before it asks.
  void heard(std::uint64_t client, const std::string& process, Clock::time_point now);

  bool held(Clock::time_point now) const { return client_ != 0 && now - heard_ <= kLost; }
  // As it calls itself; empty until its heartbeat has come.
  const std::string& holder() const { return process_; }

 private:
  std::uint64_t client_ = 0;  // 0: nobody yet
  std::string process_;
  Clock::time_point heard_{};
};

}  // namespace stepwright::dds::internal
