#pragma once

// Identifiers as small numbers. IEC 61131-3 (6.1.2) does not tell upper from lower case: "Lamp" and "LAMP"
// are one name. Not thread-safe; one per compilation.

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "runtime/base/strong_id.h"

namespace stepwright::source {

struct NameTag;
using NameId = base::StrongId<NameTag>;

// Upper case of ASCII letters; other characters stay.
std::string upper(std::string_view text);

class NameTable {
 public:
  NameId intern(std::string_view name);
  // The name, if it was interned before.
  std::optional<NameId> find(std::string_view name) const;
  // The name in upper case.
  const std::string& folded(NameId id) const { return *names_[id.value]; }

 private:
  std::unordered_map<std::string, NameId> ids_;
  std::vector<const std::string*> names_;  // keys of ids_, which never move
};

}  // namespace stepwright::source
