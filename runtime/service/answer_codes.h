#pragma once

// Codes of refusals that cross a wire and by which whoever asked decides what to do next: of the runtime
// (R...), of the way to it (D...) and of the supervisor (X...). Each has this one meaning; what else is
// refused is for people. Plain values; any thread.

namespace stepwright::service {

inline constexpr const char* kNobodyAnswers = "D0001";       // it may have happened or not
inline constexpr const char* kProgramJustChanged = "D0002";  // a name cannot be looked up yet: ask again
inline constexpr const char* kProgramDamaged = "D0003";      // it did not arrive as it was sent
inline constexpr const char* kNotAnsweredYet = "D0007";      // the supervisor has it and may obey
inline constexpr const char* kOtherVersion = "D0008";        // of the protocol: nothing was read or sent
inline constexpr const char* kHeldByAnother = "D0009";       // by another supervisor
inline constexpr const char* kOtherProgram = "R0009";  // than the request was meant for: look names up again
inline constexpr const char* kNotNow = "X0008";        // the supervisor cannot do it in its present state

}  // namespace stepwright::service
