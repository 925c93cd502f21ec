#pragma once

// The command `new`: the folder of a cell that runs as it is.

#include <string>

#include "runtime/ground/result/exit_code.h"
#include "runtime/ground/result/result.h"

namespace stepwright::new_cell {

struct NewOptions {
  std::string folder;          // its last part is the cell's name
  std::string plant = "none";  // or "tanks", "conveyor", "modbus"
};

// The whole folder, or nothing: M0018 a name that cannot name a cell, M0019 a folder that has something in
// it, E0002 what cannot be written.
[[nodiscard]] result::Result<void> make_cell(const NewOptions& options);

}  // namespace stepwright::new_cell
