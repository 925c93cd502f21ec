#include "supervisor/run/cause.h"

#include <fmt/format.h>

namespace stepwright::run {

std::string sentence_of(const std::vector<std::string>& causes) {
  return fmt::format("{}", fmt::join(causes, "; "));
}

}  // namespace stepwright::run
