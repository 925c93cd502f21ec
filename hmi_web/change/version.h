#pragma once

// A program that ran under this server: what is kept beside its container.
//
// Plain values.

#include <chrono>
#include <cstddef>
#include <string>

#include "runtime/host/limits.h"

namespace stepwright::change {

inline constexpr std::size_t kMostVersions = 20;
inline constexpr std::size_t kMostVersionBytes = 64u << 20;  // of all containers together
inline constexpr std::size_t kMostContainerBytes = host::kMaxContainerBytes;
inline constexpr std::size_t kLongestName = 200;  // of a version: the files that it was made of

enum class Outcome {
  Found,       // ran before a change from the page replaced it
  Trial,       // took over and is on trial
  Kept,        // took over and has passed its trial
  RolledBack,  // trapped on trial; the runtime went back
  Unknown,     // nobody has seen the end of its trial
};

// "found", "trial", "kept", "rolled_back", "unknown".
const char* to_string(Outcome outcome);

struct Version {
  std::string digest;  // of the container: 64 lower-case hexadecimal digits
  std::string name;    // "mixer.swb"; empty: nobody has said
  std::string user;    // who brought it last; empty: it was found
  std::string reason;
  std::string replaced;  // digest of the program that ran before it; empty: it was found
  std::chrono::system_clock::time_point when;
  Outcome outcome = Outcome::Found;
  std::string note;  // why it was rolled back
};

}  // namespace stepwright::change
