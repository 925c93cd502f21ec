#pragma once

// What the page's server keeps of its cell: [history] of the configuration.
//
//   auto recorder = open_recorder(config, picture->synoptic);
//
// Pure but for the files of the folder.

#include <memory>

#include "hmi_web/protocol/synoptic.h"
#include "hmi_web/recorder/cell_recorder.h"
#include "programs/config/cell_config.h"
#include "runtime/result/result.h"

namespace stepwright::hmi {

// Null if the configuration names no folder. Fails with what is wrong in the alarms' file (C0601 to C0605) or
// with the folder (S0001 to S0008).
[[nodiscard]] result::Result<std::unique_ptr<recorder::CellRecorder>> open_recorder(
    const config::CellConfig& config, const protocol::Synoptic& synoptic);

}  // namespace stepwright::hmi
