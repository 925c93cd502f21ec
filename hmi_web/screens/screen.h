#pragma once

// A screen: a drawing that people make in the browser, in versions. None is ever changed; each says who saved
// it, when and why.
//
// Plain values. Invariant: the newest version that does not lie aside is the screen as it is shown.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace stepwright::screens {

inline constexpr std::size_t kMostScreens = 128;
inline constexpr std::size_t kMostVersions = 50;  // of a screen; the oldest go
inline constexpr std::size_t kLongestName = 64;
inline constexpr std::size_t kLongestComment = 200;  // bytes
// Whose pages can open with a screen of their own; administrators see that of engineers.
inline constexpr std::array<const char*, 3> kStartRoles = {"viewer", "operator", "engineer"};

struct Version {
  std::uint32_t number = 0;  // 0: a file that somebody has put beside the versions
  std::uint32_t based_on = 0;
  std::string saved_by = {};
  std::chrono::system_clock::time_point saved = {};
  std::string comment = {};
  std::string least = "viewer";  // the role from which it is shown
  bool is_symbol = false;        // a face for others to repeat
  bool aside = false;            // somebody else had saved before: kept, and not shown
  bool removed = false;          // from here on there is no such screen
};

struct Screen {
  std::string name;
  std::vector<Version> versions;  // the oldest first, at least one

  // The one that is shown; null: all lie aside.
  const Version* current() const;
  // The same where people look at it; null: it was removed, or is a face that others repeat.
  const Version* shown() const;
};

}  // namespace stepwright::screens
