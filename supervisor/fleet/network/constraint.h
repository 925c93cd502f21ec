#pragma once

// Parts of a simple temporal network: timepoints, and least distances between two of them. Values; any
// thread.
//
//   const Constraint at_least{entry, exit, 4000, label};   // t(exit) - t(entry) >= 4 s
//   const Constraint at_most{exit, entry, -9000, label};   // t(exit) - t(entry) <= 9 s, the other way round

#include <cstdint>

#include "runtime/base/strong_id.h"

namespace stepwright::fleet {

struct TimepointTag;
using Timepoint = base::StrongId<TimepointTag>;

// Time zero. Every network has it.
inline constexpr Timepoint kOrigin{0};

// No timepoint is later; bounds of this size and above bind nothing.
inline constexpr std::int32_t kHorizon_ms = 100'000'000;

// t(to) - t(from) >= least_ms, |least_ms| <= kHorizon_ms + 1.
struct Constraint {
  Timepoint from;
  Timepoint to;
  std::int32_t least_ms = 0;
  std::uint32_t label = 0;  // the caller's name for it: what an explanation is made of

  friend bool operator==(const Constraint&, const Constraint&) = default;
};

}  // namespace stepwright::fleet
