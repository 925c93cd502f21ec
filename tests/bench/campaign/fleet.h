#pragma once

// The campaign's third cell: the hall of six forklifts with its real planner, compiler, scan and plant in one
// thread. Each run has one thing happen to it at a random moment of the job: an order, a place that is
// blocked, a vehicle that dies, or one that dies and comes back. A run is lost if it hangs, if it ends
// although it could have gone on or without a reason that what happened gives, or if anything met.
//
// Threads: a run belongs to one, and so does its service; `fleet_campaign` spreads runs over its own.
//
//   FleetCell cell;
//   const FleetRun run = run_fleet(cell, 30);
//   EXPECT_NE(run.verdict, Verdict::Lost) << run.story << run.why;

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/run/run_record.h"
#include "tests/bench/campaign/fleet_moment.h"
#include "tests/bench/campaign/run.h"

namespace stepwright::campaign {

// Configuration and service of tests/cells/fleet: made once for any number of runs, one after the other.
class FleetCell {
 public:
  FleetCell();
  ~FleetCell();

  struct Parts;
  Parts& parts() { return *parts_; }

 private:
  std::unique_ptr<Parts> parts_;
};

struct FleetRun {
  FleetMoment moment;
  Verdict verdict = Verdict::Lost;
  std::string why;  // of a lost run; else what is missing of one that stopped safely
  run::RunRecord record;
  double longest_plan_ms = 0.0;  // of wall time
};

FleetRun run_fleet(FleetCell& cell, std::uint64_t seed);

struct FleetClass {
  std::uint64_t runs = 0;
  std::uint64_t delivered = 0;
  std::uint64_t safe_stops = 0;  // with a reason
  std::uint64_t lost = 0;
  std::uint64_t plans = 0;  // behind the first one of each run
  double plan_ms_sum = 0.0;
  double longest_plan_ms = 0.0;
};

struct FleetFigures {
  std::map<std::string, FleetClass> of;  // by kind of moment; "all" is their sum
  std::vector<FleetRun> lost;            // by seed
  std::optional<FleetRun> newest;        // that ended last
  double wall_s = 0.0;

  std::uint64_t runs() const;
};

// Seeds `first` to `first + runs - 1`. `told` and `cancel` as those of `campaign`.
FleetFigures fleet_campaign(std::uint64_t first, std::uint64_t runs, unsigned threads,
                            const std::function<void(std::uint64_t done)>& told = {},
                            const std::atomic<bool>* cancel = nullptr);

std::string table(const FleetFigures& figures);
std::string to_json(const FleetFigures& figures, std::uint64_t first, unsigned threads);

}  // namespace stepwright::campaign
