#pragma once

namespace stepwright::boards {

inline constexpr const char* kBoardName = "mps2-an385";  // Cortex-M3

}  // namespace stepwright::boards
