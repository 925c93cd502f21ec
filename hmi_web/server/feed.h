#pragma once

// Feed of the viewers: holds the newest data and, in a Cursor for each viewer, what has been sent to it. A
// viewer names its known state and its choice of data, and pulls its next message when the one before has
// been sent. There is no queue for a viewer, so a slow reader skips snapshots and costs nothing.
//
//   Feed feed({"bench", "0.1.0"}, synoptic);
//   feed.update(view, now);                            // the polling thread, every few milliseconds
//   if (auto why = feed.hear(cursor, text)) close(*why);           // the network thread, per viewer
//   while (auto message = feed.next(cursor)) write(*message);
//
// Thread rule: every function from any thread (one lock); a cursor belongs to one viewer, and one thread at a
// time. Messages: hmi_web/doc/protocol.md.

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hmi_web/protocol/live_state.h"
#include "hmi_web/protocol/messages.h"
#include "hmi_web/protocol/viewer_message.h"
#include "hmi_web/server/cell_viewer.h"
#include "hmi_web/server/trend_buffer.h"

namespace stepwright::server {

// Shared: several viewers write the same text at the same time.
using MessageText = std::shared_ptr<const std::string>;

struct FeedOptions {
  std::chrono::milliseconds beat{1'000};         // a viewer hears something at least this often
  std::chrono::milliseconds state_spacing{0};    // between two states, at the shortest; 0: as they come
  std::chrono::milliseconds trend_spacing{100};  // between two rows of the trend
  std::size_t trend_rows = 6'000;                // kept: ten minutes
  std::size_t trend_rows_per_message = 1'000;
  std::size_t max_plan_bytes = 16u << 20;  // a longer plan document is ignored
  std::string epoch = {};                  // of this run of the server; empty = a random one
};

class Feed {
 public:
  // How far a viewer has got and what it wants; a new one begins with the default.
  struct Cursor {
    bool greeted = false;
    bool begun = false;  // it has said what it has and wants; until then it is greeted only
    protocol::Show show;
    bool shown = false;  // the values of all tags of `show` are on their way
    std::uint64_t program = 0;
    std::uint64_t state = 0;
    std::uint64_t routes = 0;
    std::uint64_t pictures = 0;
    std::uint64_t plan = 0;
    std::uint64_t alarms = 0;
    std::uint64_t forces = 0;
    std::uint64_t trend_run = 0;
    std::uint64_t trend_row = 0;
    bool trend_begun = false;
  };

  Feed(const protocol::Greeting& greeting, const protocol::Synoptic& synoptic,
       const FeedOptions& options = {});

  // Takes over what is seen now. True if viewers have something to fetch.
  bool update(const CellView& view, std::chrono::steady_clock::time_point now);

  // The newest message about alarms (hmi_web/doc/protocol.md), whole.
  void set_alarms(const std::string& message);
  // The list of what is forced, a JSON object (api::ForceService::json).
  void set_forces(const std::string& list);

  // Takes what a viewer says; what is wrong with it comes back, fit for the reason of a close.
  [[nodiscard]] std::optional<std::string> hear(Cursor& cursor, std::string_view message) const;

  // The next message that a viewer at `cursor` misses, and moves the cursor past it; null = up to date.
  MessageText next(Cursor& cursor) const;

 private:
  using Time = std::chrono::steady_clock::time_point;

  bool take_program(const CellView& view);
  bool take_state(const CellView& view, bool whole, Time now);
  bool take_plan(const CellView& view);
  void take_routes(std::string routes);
  bool take_pictures(const CellView& view);
  bool take_trend(const protocol::CellState& state, Time now);
  void go_on(Cursor& cursor, const protocol::ViewerState& has) const;
  bool is_current(const protocol::TagChoice& tags) const;
  std::optional<std::string> refusal(const protocol::TagChoice& tags) const;
  MessageText next_state(Cursor& cursor) const;
  MessageText next_trend(Cursor& cursor) const;

  FeedOptions options_;
  std::string epoch_;
  MessageText hello_;
  std::vector<std::size_t> trend_points_;  // indices of the points that are drawn over time

  mutable std::mutex mutex_;  // guards everything below
  std::shared_ptr<const ProgramLayout> layout_;
  MessageText program_;  // null = never one
  std::uint64_t program_revision_ = 0;
  protocol::CellState state_;
  std::uint64_t sequence_ = 0;     // of state_; 0 = never one
  std::uint64_t state_begin_ = 1;  // the first of this program: who has an older one needs the whole state
  protocol::LiveState live_;       // state_ as texts
  // Those of sequence_ that somebody has asked for.
  mutable std::vector<std::pair<protocol::StateRequest, MessageText>> made_;
  Time last_sent_{};
  std::string plan_source_;
  std::string routes_source_;
  MessageText routes_;  // of a fleet; null = never any
  std::uint64_t routes_revision_ = 0;
  std::string pictures_source_;
  MessageText pictures_;  // of a plan; null = never any
  std::uint64_t pictures_revision_ = 0;
  MessageText plan_;
  std::uint64_t plan_revision_ = 0;
  MessageText alarms_;
  std::uint64_t alarms_revision_ = 0;
  MessageText forces_;  // null = nobody has told
  std::uint64_t forces_revision_ = 0;
  TrendBuffer trend_;
  Time last_trend_{};
};

}  // namespace stepwright::server
