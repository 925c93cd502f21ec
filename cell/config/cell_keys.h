#pragma once

// Descriptions of the keys of a cell's file for people (runtime/ground/settings/key_words.h). Types, defaults
// and ranges are not here: the readers have them, and cell/reference puts both together. A key without words,
// and words without a key, fail the test of cell/reference.
//
// Pure; any thread.

#include <span>

#include "runtime/ground/settings/key_words.h"

namespace stepwright::config {

// Of all tables of the file, those of the planners included.
std::span<const settings::KeyWords> cell_keys();

// By part; cell_keys() has them all.
std::span<const settings::KeyWords> process_keys();  // [cell], [runtime], [hmi], ...
std::span<const settings::KeyWords> safety_keys();   // [safe_state], [watchdog], [io], [guard]
std::span<const settings::KeyWords> plant_keys();    // [plant]
std::span<const settings::KeyWords> modbus_keys();   // [modbus]

}  // namespace stepwright::config
