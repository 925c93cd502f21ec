#pragma once

// The table [change] of a cell's configuration: how programs take over from each other while they run.
//
//   [change]
//   trial_scans = 10
//
// Read by load_cell_config, whose diagnostics it shares. Plain data.

#include <cstdint>

namespace stepwright::settings {
class TomlTable;
}

namespace stepwright::config {

struct ChangeConfig {
  std::uint32_t trial_scans = 10;  // a trap within so many scans brings the old program back; 0: never
};

ChangeConfig read_change(const settings::TomlTable& root);

}  // namespace stepwright::config
