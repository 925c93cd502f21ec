#pragma once

// Options of the gateway's libraries from the [controller] of a cell's configuration. Pure; any thread.

#include <memory>

#include "cell/config/cell_config.h"
#include "runtime/ground/result/result.h"
#include "runtime/remote/register_line.h"
#include "runtime/remote/remote_config.h"

namespace stepwright::gateway {

// Opens nothing yet. Fails with R0126 for what no line can have, at the table's place.
[[nodiscard]] result::Result<std::unique_ptr<remote::RegisterLine>> make_line(
    const config::ControllerConfig& controller);

// Fails as cell_runtime::host_options does.
[[nodiscard]] result::Result<remote::RemoteConfig> remote_options(const config::CellConfig& config);

}  // namespace stepwright::gateway
