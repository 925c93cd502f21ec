#pragma once

// Note of a declaration on its variable for people, beside the comment (hmi_web/doc/tags.md). Values; use
// from any thread.

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stepwright::graphic {

struct TagNote {
  std::string unit{};
  std::string description{};
  std::string group{};
  std::optional<int> decimals{};
  std::optional<std::pair<double, double>> range{};  // least and greatest normal value
  std::vector<std::string> values{};                 // names of 0, 1, 2, ...
};

}  // namespace stepwright::graphic
