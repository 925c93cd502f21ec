#pragma once

// Codes of what is wrong with way-points, limits and tables (doc: supervisor/doc/motion_timing.md).

namespace stepwright::motion::code {

inline constexpr const char* kShortPath = "A0501";      // less than two way-points, or too many of them
inline constexpr const char* kJointCount = "A0502";     // numbers of joints that do not agree
inline constexpr const char* kNotFinite = "A0503";      // a coordinate that is no number or beyond 1e6
inline constexpr const char* kRepeated = "A0504";       // a way-point that repeats the one before
inline constexpr const char* kBadLimit = "A0505";       // a limit, tolerance or speed that cannot be
inline constexpr const char* kCannotStop = "A0506";     // too fast to stop before the end
inline constexpr const char* kBadStopLimits = "A0507";  // not above the planned ones
inline constexpr const char* kTableFull = "A0510";      // more rows or way-points than the block has room for

}  // namespace stepwright::motion::code
