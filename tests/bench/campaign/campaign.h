#pragma once

// Many runs on all cores, and the table of what came of them.

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tests/bench/campaign/run.h"

namespace stepwright::campaign {

struct ClassFigures {
  std::uint64_t runs = 0;
  std::uint64_t goals = 0;
  std::uint64_t safe_stops = 0;
  std::uint64_t lost = 0;
  double cost_sum = 0.0;        // of the plans that reached the goal, from the start of the run
  double makespan_sum_s = 0.0;  // likewise
  double worst_level_error = 0.0;
  std::uint64_t replans = 0;
  std::uint64_t worst_replans = 0;
  std::map<std::string, std::uint64_t> incidents;  // by kind
  std::map<std::string, std::uint64_t> decisions;  // by response
  std::uint64_t kept = 0;                          // actions of old plans, of so many that were left
  std::uint64_t remaining = 0;
  std::uint64_t mended = 0;   // incidents that were answered with a plan
  std::uint64_t repairs = 0;  // incidents in which a suffix was kept
  double repair_ms_sum = 0.0;
  std::uint64_t replannings = 0;  // incidents in which a plan was made anew, taken or not
  double replan_ms_sum = 0.0;
  double decision_ms_sum = 0.0;
  double worst_decision_ms = 0.0;
};

struct LostRun {
  std::uint64_t seed = 0;
  std::string story;
  std::string why;
};

struct Figures {
  std::array<ClassFigures, kClasses> of;
  std::vector<LostRun> lost;  // by seed
  double wall_s = 0.0;
  double run_ms_sum = 0.0;

  ClassFigures all() const;
};

// Seeds `first` to `first + runs - 1` on `threads` threads. `told` is called from time to time, from one of
// them. Once `cancel` (may be null) is set no further run begins; those under way are finished and count.
Figures campaign(const executive::PlanningService& planning, std::uint64_t first, std::uint64_t runs,
                 unsigned threads, const std::function<void(std::uint64_t done)>& told = {},
                 const std::atomic<bool>* cancel = nullptr);

std::string table(const Figures& figures);
std::string to_json(const Figures& figures, std::uint64_t first, unsigned threads);

}  // namespace stepwright::campaign
