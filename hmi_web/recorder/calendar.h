#pragma once

// Real time as far as it can be believed. A calendar that is far ahead of the newest record, or that jumps
// ahead while the server runs, is wrong more often than right (a dead battery, a typing error), and what was
// once recorded at a wrong time stays there, while what is older than the history's age is deleted by it. So
// time goes on from where it was, as fast as a steady clock, until the calendar is near it again or somebody
// says that it is right.
//
//   Calendar calendar(newest_ns);
//   clock.at(scan_ns, calendar.at(wall_ns, steady_ns));
//   if (calendar.ahead_ns() > 0) tell();                     // doubted, by so much
//
// Thread rule: at() from one thread; ahead_ns() and accept() from any. Times are ns since 1970.

#include <atomic>
#include <cstdint>

namespace stepwright::recorder {

class Calendar {
 public:
  // A plant stands still over a holiday and is started again without a question.
  static constexpr std::int64_t kLargestStepNs = std::int64_t{45} * 86'400 * 1'000'000'000;

  // `newest_ns`: of what was recorded before; 0: nothing was, and any calendar is believed.
  explicit Calendar(std::int64_t newest_ns) : newest_ns_(newest_ns) {}

  std::int64_t at(std::int64_t wall_ns, std::int64_t steady_ns);
  // How far the calendar stands ahead of the time that is given; 0: it is believed.
  std::int64_t ahead_ns() const { return ahead_ns_; }
  // The calendar is right. False: it is believed already.
  bool accept();

 private:
  std::int64_t newest_ns_;
  std::int64_t steady_ns_ = 0;  // of the last call; 0: there was none
  std::atomic<std::int64_t> ahead_ns_ = 0;
  std::atomic<bool> accepted_ = false;
};

}  // namespace stepwright::recorder
