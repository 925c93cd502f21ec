#pragma once

// Note on a tag for people, beside its value, as the cell or the declaration says it (hmi_web/doc/tags.md).
//
// Plain values; any thread.

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stepwright::protocol {

struct TagNote {
  std::string name;  // of a tag of the program, or of an array for all its elements; case does not matter
  std::string unit;
  std::string description;
  std::string group;
  std::optional<int> decimals;                      // shown behind the point
  std::optional<std::pair<double, double>> normal;  // least and greatest value
  std::vector<std::string> values;                  // names of 0, 1, 2, ...

  bool says_nothing() const {
    return unit.empty() && description.empty() && group.empty() && !decimals && !normal && values.empty();
  }
};

}  // namespace stepwright::protocol
