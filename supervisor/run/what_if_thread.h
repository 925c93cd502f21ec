#pragma once

// Plans for a question of people while a run goes on: one question at a time, in a thread of its own, of
// lower priority than whatever plans for the plant. How it plans is the mission's; the form of the answers is
// that of supervisor/doc/goals.md. Nothing here touches a run or a runtime.
//
//   WhatIfThread what_if;
//   what_if.ask({"7f", "(in cup1 tray)"}, [](const std::atomic<bool>& cancel) { return plan(cancel); });
//   what_if.answer()     // JSON, the same as long as what_if.revision() is
//
// Threads: every function from any. Its end cancels and waits: what `Plan` uses must outlive it.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "runtime/ground/result/result.h"

namespace stepwright::run {

struct WhatIfAsked {
  std::string id;      // of whoever asks, comes back with the answer; up to kMaxWhatIfId bytes
  std::string goal;    // as it was asked, or the one that there is
  bool ahead = false;  // what runs is taken for ended
};

inline constexpr std::size_t kMaxWhatIfId = 64;

class WhatIfThread {
 public:
  // What belongs to the answer besides the question and `wall_ms`: a JSON object with at least `state`. May
  // throw; then the question has failed, and nothing else has.
  using Plan = std::function<std::string(const std::atomic<bool>& cancel)>;

  WhatIfThread() = default;
  ~WhatIfThread();
  WhatIfThread(const WhatIfThread&) = delete;
  WhatIfThread& operator=(const WhatIfThread&) = delete;

  // Begins to plan. Fails with X0005 for an id that is too long, X0008 while another question is planned for.
  [[nodiscard]] result::Result<void> ask(const WhatIfAsked& asked, Plan plan);
  // Ends the search for the question with this id (empty: any). X0008 where there is none.
  [[nodiscard]] result::Result<void> cancel(const std::string& id);

  // The newest question and what has come of it; "null" before the first.
  std::string answer() const;
  std::uint64_t revision() const;

 private:
  void work(const WhatIfAsked& asked, const Plan& plan);
  void publish(std::string answer);

  std::mutex turn_;  // one that asks at a time
  mutable std::mutex mutex_;
  std::string answer_ = "null";  // guarded by mutex_, as the next two
  std::uint64_t revision_ = 0;
  std::string id_;
  std::atomic<bool> planning_{false};
  std::atomic<bool> cancel_{false};
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace stepwright::run
