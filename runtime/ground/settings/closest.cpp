#include "runtime/ground/result/closest.h"

#include "runtime/ground/settings/toml_document.h"

namespace stepwright::settings {

std::string closest(std::string_view word, const std::vector<std::string>& candidates) {
  // One slip in three letters, rounded up.
  const std::string* found = result::closest(word, candidates, (word.size() + 2) / 3);
  return found == nullptr ? std::string() : *found;
}

}  // namespace stepwright::settings
