#pragma once

// Progress of the planner on stderr: one line that is written over on a terminal, a line a second elsewhere.
//
// Thread rule: one thread. Writes nothing before the first `show`.

#include <string>

#include "supervisor/pddl/planner/solve.h"

namespace stepwright::plan {

enum class ProgressMode : std::uint8_t { None, Lines, Rewrite };

// Rewrite on a terminal; elsewhere Lines if asked for, else None.
ProgressMode progress_mode(bool asked);

// "3 s: best 108 in 17 steps, bound 96, 51234 states, 12 MB"
std::string progress_text(const pddl::Progress& progress);

class ProgressLine {
 public:
  explicit ProgressLine(ProgressMode mode) : mode_(mode) {}
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  // Takes the line off the terminal.
  ~ProgressLine();

  void show(const pddl::Progress& progress);

 private:
  ProgressMode mode_;
  bool shown_ = false;
};

}  // namespace stepwright::plan
