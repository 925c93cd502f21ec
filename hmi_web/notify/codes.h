#pragma once

// Codes of notifications. Plain values; any thread.

namespace stepwright::notify {

inline constexpr const char* kNoSuchChannel = "H0084";
inline constexpr const char* kNotSent = "H0085";

}  // namespace stepwright::notify
