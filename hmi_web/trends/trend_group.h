#pragma once

// A group of trends that somebody has saved for everybody: which tags, on which axes, over how long.
//
//   TrendGroup group{.name = "filling", .series = {{"points/a1.level", "0..100"}, {"Main.pump", ""}}};
//   check_group(group);
//
// Plain values; any thread.

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::trends {

inline constexpr std::size_t kMostSeries = 12;   // as many as a page asks for at once
inline constexpr std::size_t kLongestName = 64;  // bytes
inline constexpr std::size_t kLongestTag = 512;
inline constexpr std::size_t kLongestAxis = 64;

struct TrendSeries {
  std::string tag = {};  // as the history calls it
  // Empty: with the tags of its unit. "own": one of its own. "0..100": one of its own with these ends.
  std::string axis = {};
};

struct TrendGroup {
  std::string name = {};
  std::vector<TrendSeries> series = {};  // in the order of the page
  double span_s = 3'600;                 // how long a time is shown
  std::string saved_by = {};
  std::chrono::system_clock::time_point saved{};
};

// "own", "", or two finite numbers, the first below the second.
bool is_axis(const std::string& text);

// H0082: a name that is empty, too long, "." or "..", or has control characters or blanks at its ends.
[[nodiscard]] result::Result<void> check_name(const std::string& name);

// H0082: a name that is empty, too long or has control characters; no series or too many, one tag twice, an
// axis that is none, a span beyond 0.1 s to 400 days.
[[nodiscard]] result::Result<void> check_group(const TrendGroup& group);

}  // namespace stepwright::trends
