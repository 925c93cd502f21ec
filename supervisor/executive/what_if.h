#pragma once

// Plans for a goal without running it: what it would cost and how long it would take from where the plant is,
// beside what is left of the plan that runs. Nothing here touches a run or a runtime.
//
//   WhatIf what_if(service, {.time = 10s, .memory_mb = 512});
//   what_if.ask({"7f", "(= (level a1) 4)", executive.outlook()});
//   what_if.answer()     // JSON, the same as long as what_if.revision() is
//
// Threads: every function from any. The search has a thread of its own, of lower priority than the one that
// plans for the plant; there is one at a time. The service must outlive it; its end cancels and waits.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

#include "runtime/ground/result/result.h"
#include "supervisor/executive/outlook.h"
#include "supervisor/executive/planning_service.h"

namespace stepwright::executive {

struct WhatIfOptions {
  std::chrono::milliseconds time{10'000};  // budget of one search
  std::size_t memory_mb = 512;             // by which the process may grow meanwhile
};

struct WhatIfQuestion {
  std::string id;    // of whoever asks, comes back with the answer; up to kMaxWhatIfId bytes
  std::string goal;  // PDDL; empty: the goal that there is
  Outlook outlook;
};

inline constexpr std::size_t kMaxWhatIfId = 64;
// Of a longer plan the answer has the first ones.
inline constexpr std::size_t kMostListedActions = 1'000;

class WhatIf {
 public:
  WhatIf(const PlanningService& service, const WhatIfOptions& options);
  ~WhatIf();
  WhatIf(const WhatIf&) = delete;
  WhatIf& operator=(const WhatIf&) = delete;

  // Begins to plan. Fails with X0005 for an id that is too long, X0008 while another question is planned for,
  // and as a goal in a file would (P0xxx).
  [[nodiscard]] result::Result<void> ask(WhatIfQuestion question);
  // Ends the search for the question with this id (empty: any). X0008 where there is none.
  [[nodiscard]] result::Result<void> cancel(const std::string& id);

  // The newest question and what has come of it, as supervisor/doc/goals.md says; "null" before the first.
  std::string answer() const;
  std::uint64_t revision() const;

 private:
  void plan(const WhatIfQuestion& question);
  void publish(std::string answer);

  const PlanningService& service_;
  const WhatIfOptions options_;
  std::mutex turn_;  // one that asks at a time
  mutable std::mutex mutex_;
  std::string answer_ = "null";  // guarded by mutex_, as the next two
  std::uint64_t revision_ = 0;
  std::string id_;
  std::atomic<bool> planning_{false};
  std::atomic<bool> cancel_{false};
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace stepwright::executive
