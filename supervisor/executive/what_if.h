#pragma once

// Plans for a goal without running it: what it would cost and how long it would take from where the plant is,
// beside what is left of the plan that runs. Nothing here touches a run or a runtime.
//
//   WhatIf what_if(service, {.time = 10s, .memory_mb = 512});
//   what_if.ask({"7f", "(= (level a1) 4)", executive.outlook()});
//   what_if.answer()     // JSON, the same as long as what_if.revision() is
//
// Threads: every function from any. The search has a thread of its own (supervisor/run/what_if_thread.h). The
// service must outlive it; its end cancels and waits.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "runtime/ground/result/result.h"
#include "supervisor/executive/outlook.h"
#include "supervisor/executive/planning_service.h"
#include "supervisor/run/what_if_thread.h"

namespace stepwright::executive {

struct WhatIfOptions {
  std::chrono::milliseconds time{10'000};  // budget of one search
  std::size_t memory_mb = 512;             // by which the process may grow meanwhile
};

struct WhatIfQuestion {
  std::string id;    // of whoever asks (run::WhatIfAsked)
  std::string goal;  // PDDL; empty: the goal that there is
  Outlook outlook;
};

class WhatIf {
 public:
  WhatIf(const PlanningService& service, const WhatIfOptions& options)
      : service_(service), options_(options) {}

  // Begins to plan. Fails as run::WhatIfThread does, and as a goal in a file would (P0xxx).
  [[nodiscard]] result::Result<void> ask(WhatIfQuestion question);
  // Ends the search for the question with this id (empty: any). X0008 where there is none.
  [[nodiscard]] result::Result<void> cancel(const std::string& id) { return thread_.cancel(id); }

  // The newest question and what has come of it, as supervisor/doc/goals.md says; "null" before the first.
  std::string answer() const { return thread_.answer(); }
  std::uint64_t revision() const { return thread_.revision(); }

 private:
  std::string plan(const WhatIfQuestion& question, const std::atomic<bool>& cancel) const;

  const PlanningService& service_;
  const WhatIfOptions options_;
  run::WhatIfThread thread_;  // last: it uses all of the above
};

}  // namespace stepwright::executive
