#pragma once

// Codes of an online change: why the runtime does not take a program over as things are now, and what it says
// of one that it took. Plain values; any thread.

namespace stepwright::host {

inline constexpr const char* kNoProgramRuns = "R0031";
inline constexpr const char* kDownloadUnderWay = "R0032";
inline constexpr const char* kStepLost = "R0033";
inline constexpr const char* kOutputMoves = "R0034";
inline constexpr const char* kReplacedMeanwhile = "R0035";
inline constexpr const char* kStepsUnfit = "R0036";
inline constexpr const char* kCarried = "R0037";
inline constexpr const char* kNotCarried = "R0038";

}  // namespace stepwright::host
