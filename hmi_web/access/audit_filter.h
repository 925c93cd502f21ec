#pragma once

// Entries of an audit trail that somebody looks for: by person, time, what it was done to, and any text.
//
//   const std::string lines = matching_lines(text, {.user = "ada", .text = "valve"});
//
// Pure; any thread. Lines that are no JSON match nothing.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace stepwright::access {

// An empty member matches all.
struct AuditFilter {
  std::string user = {};                           // part of the name, in any case
  std::string target = {};                         // part of what it was done to, in any case
  std::string text = {};                           // part of any other member, of the action too, in any case
  std::optional<std::int64_t> from_ms{}, to_ms{};  // since 1970; both belong to it

  bool is_empty() const { return user.empty() && target.empty() && text.empty() && !from_ms && !to_ms; }
};

// The matching ones of whole lines, in their order.
std::string matching_lines(std::string_view lines, const AuditFilter& filter);

}  // namespace stepwright::access
