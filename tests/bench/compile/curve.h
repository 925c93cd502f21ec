#pragma once

// Growth of the compile time: one kind of source at several sizes.

#include <string>
#include <vector>

namespace stepwright::bench {

struct Series {
  const char* name;
  std::string (*text)(int count);
  std::vector<int> counts;  // smallest first
};

struct Point {
  const char* series;
  int count = 0;
  double least_ms = 0;   // source to verified container, with the default warnings
  double median_ms = 0;  // the same
  double native_ms = 0;  // container to machine code; 0 where this machine has none
  double us_per_unit = 0;
  double ratio = 0;  // time per unit to that of the smallest size of the series
  long peak_kb = 0;  // of a process that compiles it once
};

// Prints a line per point as it goes. Ends the process if a source does not compile.
std::vector<Point> measure(const std::vector<Series>& all);

// The kinds: rungs, POUs, steps, tags, first values, members, labels, one long line, nested statements.
std::vector<Series> all_series();

}  // namespace stepwright::bench
