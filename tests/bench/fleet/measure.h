#pragma once

// Runs the scheduler, its baselines and its referee over instances and says what came out.

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/bench/fleet/instance.h"
#include "tests/bench/fleet/kept.h"

namespace stepwright::bench::fleet {

// Of a planning that is measured: a machine that is busy takes longer, and finds as much.
inline constexpr std::chrono::milliseconds kWholeTime{600'000};

struct Settings {
  std::uint32_t least = 2;  // vehicles on one circle
  std::uint32_t most = 10;
  std::uint32_t runs = 3;              // for each number of vehicles
  std::uint32_t literal_runs = 10000;  // of these, how many paper-literal takes part in
  std::uint32_t scale = 100;           // most vehicles in a warehouse
  double v_max_mps = 1.5;
  double cap_s = 1.0;  // of a baseline for one instance; what takes longer counts as this much
  bool literal = true;
  bool referee = true;
  bool cpu_time = false;     // of this thread, instead of wall time: for a machine that is busy
  std::string folder = ".";  // for the referee's file
  bool kept_only = false;    // of paper-literal nothing is measured anew
  Kept* kept = nullptr;      // what paper-literal took in an earlier run; may be null, not owned
};

// Of one solver over the instances of one size.
struct Times {
  std::vector<double> ms;
  std::uint32_t timeouts = 0;
  std::uint64_t nodes = 0;

  double mean() const;
  double quantile(double share) const;
};

struct CircleRow {
  std::uint32_t vehicles = 0;
  Times ours, fair, literal;
  std::uint32_t scheduled = 0, infeasible = 0;
  std::uint32_t strictly_scheduled = 0;  // in strict mode, which only the referee and the checker judge
  std::size_t most_polygons = 0;
  std::size_t conflicts = 0;        // pairs that overlap in space and in the earliest times, over all runs
  std::uint32_t disagreements = 0;  // with the referee
  std::uint32_t baseline_disagreements = 0;  // with a baseline that came to an end
  std::uint32_t unjudged = 0;                // instances on which the referee gave up
  std::uint32_t faults = 0;                  // schedules in which the checker found something
};

struct WarehouseRow {
  std::uint32_t vehicles = 0;
  std::size_t polygons = 0, pairs = 0, sections = 0;
  bool scheduled = false;
  double schedule_ms = 0.0;  // median of three, from envelopes to times
  double geometry_ms = 0.0, search_ms = 0.0;
  std::uint64_t conflicts = 0;
  double retime_ms = 0.0;  // mean over delays of 5 s at random timepoints
  double retime_worst_ms = 0.0;
  std::uint32_t faults = 0;
};

// Nothing in `error` if all is well.
CircleRow measure_circle(CircleSource& source, std::uint32_t vehicles, const Settings& settings,
                         std::string& error);
WarehouseRow measure_warehouse(std::uint32_t vehicles, const Settings& settings);

}  // namespace stepwright::bench::fleet
