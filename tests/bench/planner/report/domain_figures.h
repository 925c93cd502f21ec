#pragma once

// The figures of one domain, or of all together.
//
// Thread rule: pure functions.

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/planner/suite.h"

namespace stepwright::bench {

double median(std::vector<double> values);  // of at least one value

// Figures of another planner on its instances.
struct Rival {
  std::string name;
  int solved = 0, instances = 0;
  int lost = 0;                                // instances that it solves and ours does not
  std::optional<double> first_plan_ms_median;  // of those that it solved
  std::optional<double> time_ratio_median;     // its time over ours, where both solve; the larger the better
  std::optional<double> cpu_ratio_median;      // the same in CPU time: what compares on a busy machine
  std::optional<double> cost_ratio_to_best_known;
};

// Where the instances of a domain stand at one time.
struct Quality {
  double time_s = 0.0;
  int solved = 0;
  std::optional<double> cost_ratio;  // mean over the solved
};

struct DomainFigures {
  std::string name;
  int solved = 0, instances = 0, proved = 0;
  std::optional<double> first_plan_ms_median;
  std::optional<double> first_cost_ratio;          // of the first plans
  std::optional<double> cost_ratio_to_best_known;  // mean over the solved instances, at the end
  std::optional<double> grounding_ms_median;
  std::vector<Quality> quality_over_time;  // at the decades below the limit
  std::vector<Rival> rivals;               // the baseline, then those outside
};

// One per domain in the order of the rows, then one named "all".
std::vector<DomainFigures> figures(const Settings& settings, const std::vector<Row>& rows);

}  // namespace stepwright::bench
