#pragma once

// Places in the domain where runtimes of one name live, as their links say.
//
// Threads: any.

#include <chrono>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "runtime/dds/internal/message_endpoints.h"

namespace stepwright::dds::internal {

class Namesakes {
 public:
  // The participant outlives it.
  explicit Namesakes(Participant& participant);

  bool ok() const { return beacons_.ok(); }
  // Of which a link has spoken within the last seconds, but for `own`; a few at most.
  std::vector<std::string> places(const std::string& own) const;

 private:
  using Clock = std::chrono::steady_clock;
  void on_beacon(const service::Beacon& beacon);

  const std::string runtime_id_;
  mutable std::mutex mutex_;
  std::map<std::string, Clock::time_point> heard_;
  MessageReader<service::Beacon> beacons_;  // last: silent before what it writes to is gone
};

}  // namespace stepwright::dds::internal
