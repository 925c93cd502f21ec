#pragma once

// Tells of samples that were refused, each kind (topic, code, version) at most once a minute: a sender that
// is wrong is so with every sample.
//
// Threads: any.

#include <chrono>
#include <map>
#include <mutex>
#include <string>

#include "runtime/dds/types.h"

namespace stepwright::dds::internal {

class Trouble {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kPause{60};
  static constexpr std::size_t kMostKinds = 64;  // beyond them nothing is told until the minute is over

  explicit Trouble(OnTrouble tell) : tell_(std::move(tell)) {}

  void add(const result::Diagnostic& refused, std::uint32_t version, Clock::time_point now);

 private:
  OnTrouble tell_;
  std::mutex mutex_;
  std::map<std::string, Clock::time_point> told_;
};

}  // namespace stepwright::dds::internal
