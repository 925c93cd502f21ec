#pragma once

// The fleet of a cell: its problem, whether the problem and the plant speak of the same floor and vehicles,
// and the program of its first plan.

#include <cstddef>
#include <string>
#include <vector>

#include "programs/config/cell_config.h"
#include "runtime/result/diagnostic.h"

namespace stepwright::check {

struct FleetCheck {
  result::Diagnostics problems;
  std::size_t stops = 0;           // of the first plan
  double makespan_s = 0.0;         // likewise
  std::vector<std::byte> program;  // empty: there is none
  std::string no_plan;             // why, although nothing is wrong with the files
  bool proved = false;             // that there is none
};

// C0541: a terminal without address; C0542: another number of vehicles in the plant; C0543: another floor;
// C0544: a vehicle that stands elsewhere; and what is wrong with the problem's file.
FleetCheck check_fleet(const config::CellConfig& config);

}  // namespace stepwright::check
