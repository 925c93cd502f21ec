#pragma once

// Description of one key of a settings file for people, beside what the reader's code says of it already
// (type, default, range). Such words stand beside the readers; a test compares both.

#include <span>
#include <string>
#include <string_view>

namespace stepwright::settings {

// The range of most keys that name a file.
inline constexpr std::string_view kPathOfFile = "a path, taken from the folder of this file";

struct KeyWords {
  std::string_view key;             // dotted, the table included: "hmi.port", "plant.vehicles.x_m", "hmi"
  std::string_view text;            // one sentence
  std::string_view unit = "";       // empty: the one that the end of the name tells, if any
  std::string_view otherwise = "";  // the default in words, where it is no constant
  std::string_view range = "";      // in words, likewise
};

// By the end of the name: "_ms" is "ms", "_m_s2" is "m/s²"; empty where it tells none.
std::string_view unit_of(std::string_view key);

// Advice for a key that stands in the wrong table, or in a table of another kind; empty where there is none.
std::string advice_of(std::span<const KeyWords> words, std::string_view table, std::string_view key);

}  // namespace stepwright::settings
