#pragma once

// All alarms of a cell's page: the built-in ones, those of its monitors, and those of [history] alarms.
//
// Threads: any. Reads the file of [history] alarms.

#include <vector>

#include "cell/config/cell_config.h"
#include "hmi_web/alarms/definition.h"
#include "hmi_web/protocol/synoptic.h"
#include "runtime/ground/result/result.h"

namespace stepwright::hmi {

// Fails with what is wrong in the file. Names that are there twice are left to AlarmEngine::create.
[[nodiscard]] result::Result<std::vector<alarms::AlarmDefinition>> alarms_of(
    const config::CellConfig& config, const protocol::Synoptic& synoptic);

}  // namespace stepwright::hmi
