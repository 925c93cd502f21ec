#pragma once

// The terminals of a cell's train in the process image, where whoever drives it has them: as [plant.ports]
// says, or in a row, of which the simulated train says how long it is.
//
// A function without state; any thread. Reads the simulated train's scene.
//
//   auto terminals = terminals_of(config, *problem);
//   if (!terminals) return result::forward(terminals);

#include "cell/config/cell_config.h"
#include "runtime/ground/result/result.h"
#include "supervisor/ltl/program/train_terminals.h"
#include "supervisor/ltl/scene/scene.h"

namespace stepwright::missions {

// A hitch for each trailer that can be coupled. C0541: [plant.ports] lacks a terminal; L0504: the simulated
// hall lacks a place of the problem, told at `scene`; E0001 and those of read_scene(): the hall's scene.
[[nodiscard]] result::Result<ltl::TrainTerminals> terminals_of(const config::CellConfig& config,
                                                               const ltl::Problem& problem);

}  // namespace stepwright::missions
