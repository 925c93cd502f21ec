#pragma once

// The codes of diagnostics about charts, beside those of ladder/source/codes.h. Stable;
// ladder/doc/diagnostics has a page for each, and a test holds both together.

namespace stepwright::graphic::code {

// A chart that is not sound (sfc_chart.h).
inline constexpr const char* kNoInitialStep = "E0710";
inline constexpr const char* kBadName = "E0711";
inline constexpr const char* kNameTwice = "E0712";
inline constexpr const char* kNoTarget = "E0713";
inline constexpr const char* kNoDuration = "E0714";
inline constexpr const char* kDurationUnused = "E0715";
inline constexpr const char* kMissingEnd = "E0716";
inline constexpr const char* kUnknownStep = "E0717";
inline constexpr const char* kStepTwice = "E0718";
inline constexpr const char* kBadCondition = "E0719";
inline constexpr const char* kInitialTwice = "E0720";

// A chart that does not fit the variables around it (ladder/lowering/sfc_to_ladder.h).
inline constexpr const char* kNameOfVariable = "E0721";
inline constexpr const char* kTargetNotBool = "E0722";
inline constexpr const char* kUnknownTarget = "E0723";
inline constexpr const char* kReturnInAction = "E0724";
inline constexpr const char* kUnknownIndicator = "E0725";
inline constexpr const char* kFlagWritten = "E0726";

// Hazards of a sound chart (sfc_hazards.h).
inline constexpr const char* kStepUnreachable = "W0701";
inline constexpr const char* kNeverFires = "W0702";
inline constexpr const char* kTokenDoubled = "W0703";
inline constexpr const char* kTokenLost = "W0704";
inline constexpr const char* kDeadlock = "W0705";
inline constexpr const char* kSearchCut = "W0706";

}  // namespace stepwright::graphic::code
