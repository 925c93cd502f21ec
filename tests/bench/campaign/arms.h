#pragma once

// The campaign's cell of two arms: tests/cells/robot_cell with its real planner, compiler, scan and plant in
// one thread, one thing that happens at a random moment of a run, judged by where the plant says that things
// are and by what its judge has seen. A run is lost if it ends otherwise than with the order done or in the
// safe state for a reason that its disturbance can give, or if an arm touched what it should not.
//
// Threads: every run is by itself; `arms_campaign` spreads them over its own.
//
//   const ArmsRun run = run_arms(30);
//   EXPECT_NE(run.verdict, Verdict::Lost) << run.story << run.why;

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "supervisor/run/run_record.h"
#include "tests/bench/campaign/run.h"
#include "tests/support/controller/simulated_controller.h"

namespace stepwright::campaign {

struct ArmsRun {
  std::uint64_t seed = 0;
  std::string kind;   // "drop"
  std::string order;  // "P5"
  std::string story;  // both, with the fault and its time
  std::string fault;  // "stuck_right_4", the first one; empty: none
  Verdict verdict = Verdict::Lost;
  std::string why;  // of a lost run
  run::RunRecord record;
};

ArmsRun run_arms(std::uint64_t seed);

struct ArmsClass {
  std::uint64_t runs = 0, goals = 0, safe_stops = 0, lost = 0;
  std::uint64_t replans = 0, worst_replans = 0;
};

struct ArmsFigures {
  std::map<std::string, ArmsClass> of;  // by kind; "all" is their sum
  std::vector<ArmsRun> lost;            // by seed
  double wall_s = 0.0;

  std::uint64_t runs() const;
};

// Seeds `first` to `first + runs - 1`. `told` and `cancel` as those of `campaign`.
ArmsFigures arms_campaign(std::uint64_t first, std::uint64_t runs, unsigned threads,
                          const std::function<void(std::uint64_t done)>& told = {},
                          const std::atomic<bool>* cancel = nullptr);

std::string table(const ArmsFigures& figures);
std::string to_json(const ArmsFigures& figures, std::uint64_t first, unsigned threads);

}  // namespace stepwright::campaign
