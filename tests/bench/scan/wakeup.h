#pragma once

// Wake-up latency of a scan of 1000 rungs every millisecond beside a bare loop, idle and under load.

#include <nlohmann/json_fwd.hpp>

namespace stepwright::bench {

// Adds scan_wakeup_p999_us and bare_wakeup_p999_us, the same under load with the prefix loaded_, and prints
// them. Takes about twice `seconds`.
void measure_wakeup(double seconds, nlohmann::json& out);

}  // namespace stepwright::bench
