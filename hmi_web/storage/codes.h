#pragma once

// Codes of a database file, and what they mean for whoever opens or writes one. Pure; any thread.

#include <algorithm>
#include <array>
#include <string_view>

#include "runtime/ground/result/diagnostic.h"

namespace stepwright::storage {

inline constexpr const char* kCannotOpen = "S0001";
inline constexpr const char* kDamaged = "S0002";
inline constexpr const char* kDiskFull = "S0003";
inline constexpr const char* kInUse = "S0004";  // by another process
inline constexpr const char* kReadOnly = "S0005";
inline constexpr const char* kInputOutput = "S0006";
inline constexpr const char* kOther = "S0007";      // whatever else SQLite says
inline constexpr const char* kOtherKind = "S0008";  // of database, or of version
inline constexpr const char* kTakesTooLong = "S0009";

inline constexpr std::array kFileCodes = {kCannotOpen,  kDamaged, kDiskFull,  kInUse,       kReadOnly,
                                          kInputOutput, kOther,   kOtherKind, kTakesTooLong};

// The file is to blame, and not what was asked.
inline bool is_of_the_file(std::string_view code) {
  return std::find(kFileCodes.begin(), kFileCodes.end(), code) != kFileCodes.end();
}

// Another process has it: that one has to end first.
inline bool is_in_use(const result::Diagnostics& problems) {
  return !problems.empty() && problems.front().code == kInUse;
}

// The disk is to blame, and may mend itself.
inline bool is_of_the_disk(const result::Diagnostics& problems) {
  return !problems.empty() && is_of_the_file(problems.front().code) && !is_in_use(problems);
}

}  // namespace stepwright::storage
