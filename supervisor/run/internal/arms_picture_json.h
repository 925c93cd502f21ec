#pragma once

// The picture of a cell of arms as a JSON value (supervisor/doc/pictures.md, arms). A pure function.

#include <nlohmann/json.hpp>

#include "supervisor/run/arms_picture.h"

namespace stepwright::run::internal {

nlohmann::json arms_json(const ArmsPicture& picture);

}  // namespace stepwright::run::internal
