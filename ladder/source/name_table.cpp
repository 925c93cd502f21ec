#include "ladder/source/name_table.h"

#include "runtime/naming/ascii_names.h"

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

}  // namespace stepwright::source
