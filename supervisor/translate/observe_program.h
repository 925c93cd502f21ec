#pragma once

// A program that looks and does not act: its chart waits until levels are at rest, averages every sensor over
// a window and stays in its last step OBSERVED. For the tare before a run, for the state before replanning
// and for the final report.
//
// The variables `filtered_variable(sensor)` hold the arithmetic mean over the window (exact sum of counts),
// and `half_variable(sensor)` that over its first half: `movements` compares them. With `locate`, and only if
// no fact of a OneOf group is observed, it first drives the group's searches (the vehicle that was stopped
// between two places); LOST (kind Failed) means that none of them found one.

#include "supervisor/translate/translation.h"

namespace stepwright::translate {

struct ObserveOptions {
  milliseconds rest{1'000};
  milliseconds window{2'000};
  bool locate = false;
  std::int64_t interval_us = 10'000;
};

// Requires positive times. Steps: AT_REST (Start), SEARCH_1_1.. (Search; `search_step`), AVERAGE (Settle),
// OBSERVED (Done), LOST (Failed).
Translation observe_program(const Binding& binding, const ObserveOptions& options = {});

}  // namespace stepwright::translate
