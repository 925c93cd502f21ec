#pragma once

// Limits of what a runtime publishes of its plant: so many values, with names so long.
//
// Pure functions.

#include <span>
#include <string>

#include "runtime/ground/result/diagnostic.h"

namespace stepwright::host {

// R0081 for more than kMaxPlantValues, and for each name of more than kMaxNameBytes, with `where` as their
// place. Empty: it can.
result::Diagnostics check_plant_values(std::span<const std::string> names, const result::Location& where);

}  // namespace stepwright::host
