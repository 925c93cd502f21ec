#include "cell/config/restart_config.h"

#include <cmath>
#include <string>

namespace stepwright::config {

RestartConfig read_restart(const settings::TomlTable& io, bool shared, result::Diagnostics& problems) {
  constexpr double kMostSeconds = 3'600.0;
  constexpr double kMostStarts = 1'000.0;
  constexpr double kMsPerS = 1'000.0;
  RestartConfig restart;
  restart.automatic = io.choice("restart", "operator", {"operator", "auto"}) == "auto";
  const double after_s =
      io.number("restart_after_s", static_cast<double>(restart.after.count()) / kMsPerS, {0.0, kMostSeconds});
  restart.after = std::chrono::milliseconds(std::llround(after_s * kMsPerS));
  restart.limit = static_cast<std::uint32_t>(io.integer("restart_limit", restart.limit, {1.0, kMostStarts}));
  if (restart.automatic && !shared) {
    problems.push_back({"C0446", result::Severity::Error, io.where("restart"),
                        "the I/O of this cell is within its runtime and cannot be lost",
                        "[io] kind = \"modbus\" or \"shared_memory\""});
  }
  return restart;
}

}  // namespace stepwright::config
