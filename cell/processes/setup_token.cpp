#include "cell/processes/setup_token.h"

namespace stepwright::processes {

std::optional<std::string> setup_token_of(std::string_view line) {
  constexpr std::string_view kBefore = "stepwright hmi: set-up token ";
  const std::size_t at = line.find(kBefore);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view rest = line.substr(at + kBefore.size());
  return std::string(rest.substr(0, rest.find(' ')));
}

}  // namespace stepwright::processes
