#pragma once

// The tank bench of tests/cells/bench, both variants: start-up and grounding, time to the first plan and to
// the proof, beside a plain uniform-cost search. Times are medians; CPU time is what compares on a busy
// machine.
//
// Thread rule: one thread.

#include <nlohmann/json_fwd.hpp>

#include "runtime/ground/result/result.h"

namespace stepwright::bench {

// `variants`, `grounding_ms_bench` (from the texts to the ground task), `optimal_ms_bench`; prints as it
// goes.
[[nodiscard]] result::Result<nlohmann::json> measure_tank_cell(int repeats);

}  // namespace stepwright::bench
