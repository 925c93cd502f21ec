#pragma once

// The code of a change after which no order of the vehicles brings all of them to their ends. Plain value.

namespace stepwright::fleet {

inline constexpr const char* kNoOrder = "F1003";

}  // namespace stepwright::fleet
