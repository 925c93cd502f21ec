#pragma once

// Parses a viewer's message: its known state (`begin`, the first message) and its choice of data (`begin`,
// `show`). Specified in hmi_web/doc/protocol.md.
//
//   auto message = read_viewer_message(text);
//   if (!message) return close(message.error());
//
// Read strictly, as anybody may have written it: unknown members, other types, numbers out of range and
// lists that are too long are refused. A pure function; any thread.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace stepwright::protocol {

inline constexpr std::size_t kMostTagRanges = 200;
inline constexpr std::size_t kMostViewerBytes = 4'096;

// Of indices into the tags of a program.
struct TagRange {
  std::uint32_t first = 0;
  std::uint32_t count = 0;

  friend bool operator==(const TagRange&, const TagRange&) = default;
};

// Which tags a viewer is told of.
struct TagChoice {
  bool all = false;              // those of whatever program runs
  std::string digest;            // of the program that the ranges belong to
  std::vector<TagRange> ranges;  // ascending, none touches another

  static TagChoice everything() { return {true, {}, {}}; }
  friend bool operator==(const TagChoice&, const TagChoice&) = default;
};

struct Show {
  std::uint32_t number = 0;  // of this choice; comes back with its first values
  TagChoice tags;
  bool plan = false;
  bool routes = false;
  bool pictures = false;
  bool trend = false;
};

// Numbers of the newest data that a viewer has from an earlier connection to the same run of the server.
struct ViewerState {
  std::uint64_t sequence = 0;  // of the newest state or delta; 0 = none
  bool tags = false;           // the values of all tags that it wants are those of `sequence`
  std::uint64_t program = 0;   // revisions
  std::uint64_t plan = 0;
  std::uint64_t routes = 0;
  std::uint64_t pictures = 0;
  std::uint64_t alarms = 0;
  std::uint64_t forces = 0;
  std::uint64_t trend_run = 0;
  std::uint64_t trend_next = 0;  // number of the first row that it misses; 0 = it has none
};

struct ViewerMessage {
  bool begins = false;
  // Of a message that begins:
  std::int64_t protocol = 0;
  std::string epoch;  // empty: nothing is known yet
  ViewerState has;
  Show show;
};

// The error is one short sentence, fit for the reason of a WebSocket's close.
[[nodiscard]] tl::expected<ViewerMessage, std::string> read_viewer_message(std::string_view text);

}  // namespace stepwright::protocol
