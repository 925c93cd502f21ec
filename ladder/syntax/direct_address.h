#pragma once

// Directly represented variables (IEC 61131-3, 6.5.5) in the languages: %IX0.0, %QB3, %MW12.

#include <string>

#include "runtime/naming/direct_address.h"

namespace stepwright::syntax {

using naming::Area;
using naming::DirectAddress;
using naming::kAreaLimit;

// "%IX0.0"
std::string to_string(const DirectAddress& address);

}  // namespace stepwright::syntax
