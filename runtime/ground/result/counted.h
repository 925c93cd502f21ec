#pragma once

// A number with what is counted, in a sentence. Pure; any thread.
//
//   counted(1, "scan", "scans") + " came too late"     // "1 scan came too late"

#include <cstdint>
#include <string>
#include <string_view>

namespace stepwright::result {

inline std::string counted(std::uint64_t number, std::string_view one, std::string_view many) {
  return std::to_string(number).append(" ").append(number == 1 ? one : many);
}

}  // namespace stepwright::result
