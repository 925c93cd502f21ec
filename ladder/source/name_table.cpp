#include "ladder/source/name_table.h"

#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::source {

std::string upper(std::string_view text) {
  std::string folded(text);
  for (char& c : folded) c = naming::to_upper(c);
  return folded;
}

NameId NameTable::intern(std::string_view name) {
  const auto [entry, is_new] =
      ids_.try_emplace(upper(name), NameId(static_cast<std::uint32_t>(names_.size())));
  if (is_new) names_.push_back(&entry->first);
  return entry->second;
}

std::optional<NameId> NameTable::find(std::string_view name) const {
  const auto found = ids_.find(upper(name));
  return found == ids_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace stepwright::source
