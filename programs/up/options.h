#pragma once

// Options of `up`, `down` and `status`, and the cell that is meant. Plain data.

#include <optional>
#include <string>
#include <vector>

#include "cell/config/cell_config.h"

namespace stepwright::up {

struct Options {
  std::string cell = "cell.toml";
  std::vector<std::string> overrides;  // KEY=VALUE
  std::optional<int> port;             // up: of the page
  bool watch = false;                  // up: what is saved is compiled and brought in
  bool detach = false;                 // up: return when the cell is ready
  bool json = false;                   // status
};

// The cell's file, read and checked.
[[nodiscard]] result::Result<config::CellConfig> load(const Options& options);
// The same of a cell that may be up already, whatever has become of its file since: wrong values are left to
// who starts it.
[[nodiscard]] result::Result<config::CellConfig> load_for_a_look(const Options& options);
// With those that options stand for.
std::vector<std::string> overrides_of(const Options& options);

}  // namespace stepwright::up
