#pragma once

// Codes of kept recipes. Plain values; any thread.

namespace stepwright::recipes {

inline constexpr const char* kNoSuchRecipe = "H0072";
inline constexpr const char* kNoRoomForRecipe = "H0073";
inline constexpr const char* kRecipeDamaged = "H0078";

}  // namespace stepwright::recipes
