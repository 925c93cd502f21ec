#pragma once

// [[notify]] of a cell as the page's server tells people.
//
// Pure.

#include <span>
#include <vector>

#include "cell/config/notify_config.h"
#include "hmi_web/notify/channel.h"

namespace stepwright::hmi {

std::vector<notify::Channel> notify_channels(std::span<const config::NotifyConfig> configured);

}  // namespace stepwright::hmi
