#pragma once

// Codes of users, passwords and the files of both. Plain values; any thread.

namespace stepwright::access {

inline constexpr const char* kNoMemoryToHash = "H0020";
inline constexpr const char* kFileFails = "H0021";  // of the users, the trail, what is forced
inline constexpr const char* kNoSuchUser = "H0024";
inline constexpr const char* kNoSuchSession = "H0034";
inline constexpr const char* kLastAdministrator = "H0025";
inline constexpr const char* kNoRoomForUser = "H0029";  // its name is taken, or there are too many

}  // namespace stepwright::access
