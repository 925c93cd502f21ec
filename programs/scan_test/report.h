#pragma once

// A measurement as text for people and as JSON for programs.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/scan_test/measurement.h"

namespace stepwright::scan_test {

std::string to_text(const Measurement& measured);

// scan_wakeup_p999_us, bare_wakeup_p999_us, wakeup_ratio_p999, overruns, exec_p99_us and the whole spreads.
nlohmann::json to_json(const Measurement& measured);

}  // namespace stepwright::scan_test
