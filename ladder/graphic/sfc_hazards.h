#pragma once

// Hazards of a sound chart: what it may do that its author hardly meant (IEC 61131-3, 2.6.5, "unsafe" and
// "unreachable" charts). They are found by a search of all situations that its tokens can come to, with every
// condition TRUE or FALSE at any time. Pure function; use from any thread.
//
// All findings are warnings with the place of a step or transition and a way there as the hint:
//   W0701 a step can never become active          W0702 a transition can never fire
//   W0703 a step can be entered while active      W0704 a token can be lost: it waits for ever, others go on
//   W0705 deadlock: nothing can fire any more     W0706 (a note) the search was cut
//
// A chart of up to a quarter of `marking_limit` situations is searched as it is. One with more is searched
// once more with chains of steps and plain parallel branches melted together, which keeps the answers but
// names one step for a whole chain; only if that is cut too, W0706 says so, and nothing is said about W0704
// and W0705.
//
//   for (const result::Diagnostic& each : find_hazards(chart)) ...

#include <cstddef>

#include "ladder/graphic/sfc_chart.h"
#include "runtime/ground/result/diagnostic.h"

namespace stepwright::graphic {

struct HazardOptions {
  std::size_t marking_limit = 20'000;  // situations
};

// Requires a sound chart (`check` finds no errors). A thousand steps take a few milliseconds.
[[nodiscard]] result::Diagnostics find_hazards(const SfcChart& chart, const HazardOptions& options = {});

}  // namespace stepwright::graphic
