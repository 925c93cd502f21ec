#pragma once

namespace stepwright::boards {

inline constexpr const char* kBoardName = "mps2-an386";  // Cortex-M4F

}  // namespace stepwright::boards
