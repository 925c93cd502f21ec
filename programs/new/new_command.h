#pragma once

// The command `new`: the folder of a cell that runs as it is.

#include <string>
#include <vector>

#include "runtime/ground/result/diagnostic.h"
#include "runtime/ground/result/exit_code.h"
#include "runtime/ground/result/result.h"

namespace stepwright::new_cell {

struct NewOptions {
  std::string folder;          // its last part is the cell's name
  std::string plant = "none";  // or "tanks", "conveyor", "modbus"
  bool plan = false;           // a batch cell that plans, in place of a plant
  std::string from{};          // a PLCopen project in place of a plant: a file, or the folder of an editor
  std::string dialect = "matiec";  // then: of its sources
  std::string configuration{};     // then: of those that it has; empty: it has one
};

struct NewCell {
  std::vector<std::string> left;  // what of a project could not be taken, a line for each
  // Why its program does not compile, at the places of main.xml, and what is wrong in cell.toml; empty: it
  // runs.
  result::Diagnostics problems;
};

// The whole folder, or nothing: M0018 a name that cannot name a cell, M0019 a folder that has something in
// it, E0002 what cannot be written, M0020 and E08xx what is no PLCopen project.
[[nodiscard]] result::Result<NewCell> make_cell(const NewOptions& options);

}  // namespace stepwright::new_cell
