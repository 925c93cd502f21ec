#pragma once

// Directly represented variables (IEC 61131-3, 6.5.5) in the languages: %IX0.0, %QB3, %MW12.

#include <string>

#include "runtime/base/direct_address.h"

namespace stepwright::syntax {

using base::Area;
using base::DirectAddress;
using base::kAreaLimit;

// "%IX0.0"
std::string to_string(const DirectAddress& address);

}  // namespace stepwright::syntax
