#pragma once

// Codes of saved groups of trends. Plain values; any thread.

namespace stepwright::trends {

inline constexpr const char* kNoSuchGroup = "H0081";
inline constexpr const char* kNoGroup = "H0082";  // a name, a tag or an axis that cannot be one
inline constexpr const char* kNoRoomForGroup = "H0083";

}  // namespace stepwright::trends
