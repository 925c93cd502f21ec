#pragma once

// An audit trail for people and their programs: the newest entries as a list, all of them as a table.
//
//   const std::string page = newest_entries(text, 200);     // a JSON array, the newest first
//   const std::string table = entries_csv(text);            // RFC 4180
//
// Pure; any thread. Lines that are no JSON are left out.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace stepwright::access {

// Up to `most` entries with a number below `before` (0: from the newest on).
std::string newest_entries(std::string_view text, std::size_t most, std::uint64_t before = 0);
// A cell that a spreadsheet would take for a formula begins with an apostrophe.
std::string entries_csv(std::string_view text);

// As entries have their time: "2026-05-01T12:30:00.250Z".
std::string utc_text(std::int64_t ms_since_1970);

}  // namespace stepwright::access
