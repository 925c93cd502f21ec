#pragma once

// Codes of users and passwords. Plain values; any thread.

namespace stepwright::access {

inline constexpr const char* kNoMemoryToHash = "H0020";
inline constexpr const char* kNoSuchUser = "H0024";
inline constexpr const char* kNoSuchSession = "H0034";
inline constexpr const char* kLastAdministrator = "H0025";
inline constexpr const char* kNoRoomForUser = "H0029";  // its name is taken, or there are too many

}  // namespace stepwright::access
