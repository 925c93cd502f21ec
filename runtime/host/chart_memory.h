#pragma once

// Memory of the charts of a program, and their functions: the part of the image that a restart of the charts
// resets while every other variable keeps its value.
//
// The compiler appends the variables of a chart (step bits, step times, stored actions, action timers) behind
// the variables of the POU that holds it, in this order: the clock of the step times if there is one, the bit
// of the first step, all the rest (runtime/doc/bytecode_format.md, "Charts").
//
// Threads: any; immutable.
//
//   const ChartMemory charts = ChartMemory::of(program);
//   for (const ChartMemory::Range& range : charts.ranges()) copy(initial, image, range);

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/bytecode/program.h"

namespace stepwright::host {

class ChartMemory {
 public:
  // Bytes of the image, by address, not touching each other.
  struct Range {
    std::uint32_t address = 0;
    std::uint32_t size = 0;
  };

  static ChartMemory of(const bytecode::Program& program);

  const std::vector<Range>& ranges() const { return ranges_; }
  // True for the code of a POU that holds a chart; `function` is an index in the table.
  bool owns(std::uint32_t function) const { return function < owned_.size() && owned_[function]; }

 private:
  friend class ChartSearch;
  void join();

  std::vector<Range> ranges_;
  std::vector<bool> owned_;
};

}  // namespace stepwright::host
