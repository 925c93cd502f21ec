#include "supervisor/fleet/mission/internal/names.h"

#include <fmt/format.h>

#include "runtime/ground/result/closest.h"

namespace stepwright::fleet::internal {

void Names::add(const JsonItem& item, const std::string& name, std::size_t index) {
  if (index_.emplace(name, index).second) {
    names_.push_back(name);
    return;
  }
  const auto at = item.maybe("name");
  (at ? *at : item).refuse("F0705", fmt::format("another {} is called '{}', too", kind_, name));
}

std::optional<std::size_t> Names::find(const JsonItem& item) const {
  const auto name = item.as_text();
  if (!name) return std::nullopt;
  if (const auto found = index_.find(*name); found != index_.end()) return found->second;
  const std::string* meant = result::closest(*name, names_, 3);
  std::string hint;
  if (meant != nullptr) {
    hint = fmt::format("did you mean '{}'?", *meant);
  } else if (names_.empty()) {
    hint = fmt::format("the file has no {}", kind_);
  }
  item.refuse("F0704", fmt::format("no {} is called '{}'", kind_, *name), std::move(hint));
  return std::nullopt;
}

std::optional<std::size_t> Names::find_member(const JsonItem& item, const char* member, bool required) const {
  const auto found = required ? item.member(member) : item.maybe(member);
  return found ? find(*found) : std::nullopt;
}

}  // namespace stepwright::fleet::internal
