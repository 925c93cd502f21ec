#pragma once

// Codes of what people do to alarms. Plain values; any thread.

namespace stepwright::alarms {

inline constexpr const char* kNotInThisState = "C0606";  // nor by the alarm's definition
inline constexpr const char* kNoSuchAlarm = "C0607";

}  // namespace stepwright::alarms
