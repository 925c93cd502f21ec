#pragma once

// The JSON messages that the server sends to a viewer, as texts ready for the wire. Their meaning and order
// are specified in hmi_web/doc/protocol.md; `kProtocolVersion` changes when an old client would misread them.
//
// Pure functions; callable from any thread. Text that is not UTF-8 is repaired, numbers that are not finite
// become null: no input makes them fail.
//
//   socket.send(hello_message({"bench", "0.1.0"}, synoptic));
//   socket.send(state_message(state, 1));
//   socket.send(delta_message(state, next_state, 2));

#include <cstdint>
#include <span>
#include <string>

#include "hmi_web/protocol/cell_state.h"
#include "hmi_web/protocol/program.h"
#include "hmi_web/protocol/synoptic.h"

namespace stepwright::protocol {

inline constexpr int kProtocolVersion = 2;

struct Greeting {
  std::string cell;
  std::string server_version;
  bool recipes = false;  // the API has some
  bool drawing = false;  // the API has one of the plant
};

std::string hello_message(const Greeting& greeting, const Synoptic& synoptic);
std::string program_message(const Program& program);
std::string state_message(const CellState& state, std::uint64_t sequence);

// Only what differs; points and tags as {"index": value}. `before` and `now` belong to the same program.
std::string delta_message(const CellState& before, const CellState& now, std::uint64_t sequence);

// `first` is the number of the first row; a viewer that gets `restart` throws away the rows that it has.
std::string trend_message(std::span<const TrendRow> rows, std::uint64_t first, bool restart);

// The supervisor's plan document: plan_parts.h.

}  // namespace stepwright::protocol
