#pragma once

// The register map of a program as a document. Pure functions.

#include <string>
#include <vector>

#include "runtime/modbus/map/register_rows.h"

namespace stepwright::registers {

// A table a Modbus table, with the default map's ranges in words if it is there.
std::string to_markdown(const std::vector<modbus::map::RegisterRow>& rows, const std::string& title,
                        bool openplc);
// RFC 4180: table, address, registers, functions, name, type, iec_address, access, byte_order, word_order,
// comment.
std::string to_csv(const std::vector<modbus::map::RegisterRow>& rows);
// A list of objects with the same keys.
std::string to_json(const std::vector<modbus::map::RegisterRow>& rows);

}  // namespace stepwright::registers
