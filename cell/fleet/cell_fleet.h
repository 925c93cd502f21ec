#pragma once

// Options of a fleet's programs from a cell's configuration: used by supervisor, fleet and check alike. Any
// thread.

#include <filesystem>
#include <optional>

#include "cell/config/cell_config.h"
#include "runtime/ground/result/result.h"
#include "supervisor/fleet/program/fleet_program.h"

namespace stepwright::config {

// Where the terminals of v1, v2, ... are: as [plant.ports] says, without it in a row. C0541: a terminal has
// no address there; C0542: the plant has another number of vehicles.
[[nodiscard]] result::Result<fleet::FleetTerminals> fleet_terminals(const CellConfig& cell,
                                                                    std::size_t vehicles);

// So many vehicles a problem's file has; nothing if it cannot be told, which is said by whoever reads it.
std::optional<std::size_t> fleet_size(const std::filesystem::path& problem);

// Where look-up tables of vehicles are kept: $XDG_CACHE_HOME/stepwright, or in ~/.cache; empty: nowhere.
std::filesystem::path fleet_table_folder();

// The interval of the scan; whether picked-up loads show in the plant.
fleet::ProgramOptions fleet_program_options(const CellConfig& cell);

}  // namespace stepwright::config
