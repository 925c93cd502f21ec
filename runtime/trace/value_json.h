#pragma once

// Values of variables in reports. Pure; any thread.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/bytecode/reader/read_value.h"

namespace stepwright::trace {

// JSON has no infinities: they are written as their names.
nlohmann::json to_json(const reader::Value& value);

// As 16 hexadecimal digits: JSON numbers lose the last bits of a hash.
std::string hex(std::uint64_t value);

}  // namespace stepwright::trace
