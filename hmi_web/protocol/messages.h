#pragma once

// The JSON messages that the server sends to a viewer, as texts ready for the wire. Their meaning and order
// are specified in hmi_web/doc/protocol.md; `kProtocolVersion` changes when an old client would misread them.
//
// Pure functions; callable from any thread. Text that is not UTF-8 is repaired, numbers that are not finite
// become null: no input makes them fail.
//
//   socket.send(hello_message({"bench", "0.1.0"}, synoptic));
//   socket.send(program_message(program, {{3}, {}}));

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_web/protocol/cell_state.h"
#include "hmi_web/protocol/program.h"
#include "hmi_web/protocol/synoptic.h"
#include "hmi_web/protocol/tag_note.h"

namespace stepwright::protocol {

inline constexpr int kProtocolVersion = 5;

struct Greeting {
  std::string cell;
  std::string server_version;
  bool recipes = false;  // the API has some
  bool drawing = false;  // the API has one of the plant
  std::vector<TagNote> tags = {};
};

// `epoch` names this run of the server: numbers of another one mean nothing.
std::string hello_message(const Greeting& greeting, const Synoptic& synoptic, const std::string& epoch);
// `points`: of a picture without points, or without a program, none.
std::string program_message(const Program& program, const PointTags& points = {});

// Rows of a run of the trend; a viewer that gets `restart` throws away the rows that it has.
struct TrendPiece {
  std::uint64_t run = 0;
  std::uint64_t first = 0;  // number of the first row
  bool restart = false;
};
std::string trend_message(std::span<const TrendRow> rows, const TrendPiece& piece);

// An object as JSON text with its revision in front of its members, so that a viewer can say later which one
// it has.
std::string with_revision(std::string_view object, std::uint64_t revision);

// The state and what changes in it: live_state.h.

// The supervisor's plan document: plan_parts.h.

}  // namespace stepwright::protocol
