#pragma once

// Alarms through engine, figures and journal beside a plain insert of the same rows: one commit for each
// change, and all in one transaction. Then 10,000 changes a second for some seconds, as a plant would bring
// them: is anything lost, and how long does the one who brings them wait?

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace stepwright::bench {

struct AlarmLoad {
  std::size_t changes = 200'000;  // as fast as they go
  std::uint32_t alarms = 1'000;
  double rate = 10'000.0;  // of the burst
  double seconds = 3.0;
};

// Writes into the folder, prints the figures and gives them.
nlohmann::json measure_alarms(const AlarmLoad& load, const std::filesystem::path& folder);

}  // namespace stepwright::bench
