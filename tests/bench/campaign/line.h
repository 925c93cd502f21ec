#pragma once

// The campaign's other cell: the sorting line with its real planner, compiler, safety program, scan and plant
// in one thread, one random fault a run, judged by where the plant says that its boxes are. A run is lost if
// it ends otherwise than with the order met or in the safe state, if it gives up because of what somebody has
// put right, or if paddle and belt ever met.
//
// Threads: every run is by itself; `line_campaign` spreads them over its own.
//
//   const LineRun run = run_line(30);
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

struct LineRun {
  std::uint64_t seed = 0;
  std::string fault;  // "jam_d1"
  std::string story;  // the fault with its times
  Verdict verdict = Verdict::Lost;
  std::string why;  // of a lost run
  run::RunRecord record;
};

// A random fault at a random time; of those that somebody can put right, until that is done and reset was
// pressed.
std::vector<support::PlantFault> line_faults(std::uint64_t seed);

LineRun run_line(std::uint64_t seed);

struct LineClass {
  std::uint64_t runs = 0;
  std::uint64_t goals = 0;
  std::uint64_t safe_stops = 0;
  std::uint64_t lost = 0;
  std::uint64_t replans = 0;
  std::uint64_t worst_replans = 0;
  double decision_ms_sum = 0.0;
  std::uint64_t incidents = 0;
};

struct LineFigures {
  std::map<std::string, LineClass> of;  // by kind of fault, "jam"; "all" is their sum
  std::vector<LineRun> lost;            // by seed
  double wall_s = 0.0;

  std::uint64_t runs() const;
};

// Seeds `first` to `first + runs - 1`. `told` and `cancel` as those of `campaign`.
LineFigures line_campaign(std::uint64_t first, std::uint64_t runs, unsigned threads,
                          const std::function<void(std::uint64_t done)>& told = {},
                          const std::atomic<bool>* cancel = nullptr);

std::string table(const LineFigures& figures);
std::string to_json(const LineFigures& figures, std::uint64_t first, unsigned threads);

}  // namespace stepwright::campaign
