#pragma once

// Private to this folder: a floor as a part of the greeting.

#include <nlohmann/json.hpp>

#include "hmi_web/protocol/floor.h"

namespace stepwright::protocol {

nlohmann::json floor_json(const Floor& floor);

}  // namespace stepwright::protocol
