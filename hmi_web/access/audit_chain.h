#pragma once

// The chain of an audit trail: how a line is made, and whether lines are what was written.
//
//   const ChainCheck check = check_chain(text);                  // the whole chain
//   const ChainCheck more = check_chain(next, {check.entries, check.head});   // what follows it
//   if (!check.broken_line) print(check.entries, "entries, the last one", check.head);
//
// Pure; any thread. Whoever can write the file can cut off lines at its end, or make the whole chain anew: to
// find that, keep the head of `stepwright hmi --verify-audit` somewhere else.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "hmi_web/access/audit_log.h"

namespace stepwright::access {

struct ChainLine {
  std::string text;  // with its end of line
  std::string hash;
};

// `time`: ISO 8601, UTC. Bytes that are not UTF-8 are replaced.
ChainLine chain_line(const AuditEntry& entry, std::uint64_t sequence, const std::string& time,
                     const std::string& previous_hash);

// Of the line before the first one.
std::string first_hash();

// Where lines go on from: the line before the first of them.
struct ChainStart {
  std::uint64_t sequence = 0;
  std::string head = first_hash();
};

struct ChainCheck {
  std::uint64_t entries = 0;      // the number of the last right line
  std::string head;               // hash of the last of them
  std::uint64_t broken_line = 0;  // the number that the first wrong line should have; 0: none
  std::string why;                // what is wrong with it
  std::size_t right_bytes = 0;    // up to the end of the last right line
  bool torn = false;              // the wrong line is the last one and has no end: a crash while writing
};

ChainCheck check_chain(std::string_view text, const ChainStart& start = {});

// The predecessor that the first line of `text` names, for text that does not begin with the chain. Nothing:
// it is no line of a trail.
std::optional<ChainStart> start_of(std::string_view text);
// The number of a line; 0: it has none.
std::uint64_t sequence_of(std::string_view line);

}  // namespace stepwright::access
