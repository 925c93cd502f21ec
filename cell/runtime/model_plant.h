#pragma once

// The plant of a cell whose file describes it by components: kind = "model". Set-up only.

#include <memory>
#include <optional>
#include <vector>

#include "cell/config/cell_config.h"
#include "plant_models/bridge/plant_driver.h"
#include "plant_models/core/plant.h"
#include "runtime/ground/result/result.h"

namespace stepwright::cell_runtime {

// Fails with what is wrong in the plant's file (components::ModelPlant::load()). `left`: as a killed runtime
// left it.
[[nodiscard]] result::Result<std::unique_ptr<core::Plant>> make_model(
    const config::CellConfig& cell, const std::optional<std::vector<double>>& left = std::nullopt);

// What is wrong with a plant whose file is sound: more values than a runtime publishes (R0081), a plant that
// gives up within its first second (C0351). Processes of its parts are not started.
[[nodiscard]] result::Diagnostics check_model(const config::CellConfig& cell);

// Whether the plant's file can be read, so that its terminals are known.
bool knows_model_wires(const config::PlantConfig& plant);
// The terminals that the plant's file has; none if it cannot be read.
std::vector<bridge::PortWire> model_wires(const config::PlantConfig& plant);

}  // namespace stepwright::cell_runtime
