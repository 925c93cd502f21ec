#pragma once

// Names of a problem file and what they stand for: tells names that are used twice and names that are
// unknown, with what may have been meant. A value.

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/fleet/mission/internal/json_item.h"

namespace stepwright::fleet::internal {

class Names {
 public:
  explicit Names(std::string kind) : kind_(std::move(kind)) {}

  // F0705 if the name is taken; the first one keeps it.
  void add(const JsonItem& item, const std::string& name, std::size_t index);
  // F0704 at the member if it is unknown.
  std::optional<std::size_t> find(const JsonItem& name) const;
  std::optional<std::size_t> find_member(const JsonItem& item, const char* member,
                                         bool required = true) const;

 private:
  std::string kind_;  // "location"
  std::vector<std::string> names_;
  std::map<std::string, std::size_t> index_;
};

}  // namespace stepwright::fleet::internal
