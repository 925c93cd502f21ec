#pragma once

// Holds the newest state of a cell as texts, each with the number of the message in which it changed last. So
// the difference since any message is found without keeping messages.
//
//   LiveState live;
//   live.take(state, 1, true);
//   socket.send(live.message({.tags = TagChoice::everything()}));      // "state", the whole
//   live.take(next, 2, false);
//   socket.send(live.message({.since = 1, .tags = TagChoice::everything()}));  // "delta", what differs
//
// Thread rule: one thread at a time. Every message is of the newest state, and so of one scan. Text that is
// not UTF-8 is repaired, numbers that are not finite become null.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hmi_web/protocol/cell_state.h"
#include "hmi_web/protocol/viewer_message.h"

namespace stepwright::protocol {

// Request for the content of a message.
struct StateRequest {
  std::uint64_t since = 0;  // the viewer has what came up to this number; 0: nothing, it gets a `state`
  TagChoice tags;           // digest apart: indices of the tags of the newest state
  // The number of a viewer's choice that is answered for the first time: all its tags and not only those
  // that differ. A `state` always holds them all.
  std::optional<std::uint32_t> show;

  friend bool operator==(const StateRequest&, const StateRequest&) = default;
};

class LiveState {
 public:
  // `sequence` is greater than the one before. `anew`: of another program than before, whose tags are others.
  void take(const CellState& now, std::uint64_t sequence, bool anew);
  std::string message(const StateRequest& request) const;

 private:
  struct Field {
    std::string name;
    std::string text;
    std::uint64_t changed = 0;  // 0: never had a value
  };
  struct Number {
    std::optional<double> value;
    std::string text;
    std::uint64_t changed = 0;
    bool is_text = false;

    void take_text(std::string fresh, std::uint64_t sequence);
  };
  static void take_points(const std::vector<std::optional<double>>& values, std::uint64_t sequence,
                          std::vector<Number>& kept);
  static void take_tags(const CellState& now, std::uint64_t sequence, std::vector<Number>& kept);
  static void append(const std::vector<Number>& numbers, TagRange range, std::uint64_t since,
                     std::string& text);
  void append_tags(const StateRequest& request, std::string& text) const;
  void append_points(std::uint64_t since, std::string& text) const;

  std::uint64_t sequence_ = 0;
  std::vector<Field> fields_;
  std::vector<Number> points_;
  std::vector<Number> tags_;
};

}  // namespace stepwright::protocol
