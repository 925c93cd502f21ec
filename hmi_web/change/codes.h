#pragma once

// Codes of kept program versions. Plain values; any thread.

namespace stepwright::change {

inline constexpr const char* kNoSuchVersion = "H0091";
inline constexpr const char* kVersionDamaged = "H0095";

}  // namespace stepwright::change
