#pragma once

// Codes of screens. Plain values; any thread.

namespace stepwright::screens {

inline constexpr const char* kNoSuchScreen = "H0120";
inline constexpr const char* kNoName = "H0121";          // it cannot be the name of a screen
inline constexpr const char* kSavedMeanwhile = "H0122";  // by somebody else; both versions are kept
inline constexpr const char* kNoRoomForScreen = "H0123";
inline constexpr const char* kScreenDamaged = "H0124";
inline constexpr const char* kPartNeverWrites = "C0645";

}  // namespace stepwright::screens
