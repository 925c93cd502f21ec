#include "hmi_web/server/feed.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <random>
#include <utility>

#include "hmi_web/protocol/pictures.h"
#include "hmi_web/protocol/plan_parts.h"

namespace stepwright::server {
namespace {

MessageText shared(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

std::vector<std::size_t> trend_points(const protocol::Synoptic& synoptic) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < synoptic.points.size(); ++i) {
    if (synoptic.points[i].trend) indices.push_back(i);
  }
  return indices;
}

// Nobody guesses it, and no two runs have the same.
std::string random_epoch() {
  std::random_device source;
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%08x%08x", source(), source());
  return digits.data();
}

// A page that was shown something else is told of the newest; one with a number that was never given, too.
std::uint64_t known(std::uint64_t claimed, std::uint64_t newest) {
  return claimed <= newest ? claimed : 0;
}

}  // namespace

Feed::Feed(const protocol::Greeting& greeting, const protocol::Synoptic& synoptic, const FeedOptions& options)
    : options_(options),
      epoch_(options.epoch.empty() ? random_epoch() : options.epoch),
      hello_(shared(protocol::hello_message(greeting, synoptic, epoch_))),
      trend_points_(trend_points(synoptic)),
      trend_(options.trend_rows) {}

bool Feed::update(const CellView& view, Time now) {
  const std::lock_guard lock(mutex_);
  const bool program = take_program(view);
  const bool state = take_state(view, program, now);
  const bool pictures = take_pictures(view);
  const bool plan = take_plan(view);
  const bool trend = take_trend(view.state, now);
  return program || state || pictures || plan || trend;
}

bool Feed::take_program(const CellView& view) {
  if (view.layout == layout_) return false;
  layout_ = view.layout;
  const auto message = protocol::program_message(layout_ ? layout_->program : protocol::Program{},
                                                 view.points ? *view.points : protocol::PointTags{});
  program_ = shared(protocol::with_revision(message, ++program_revision_));
  return true;
}

bool Feed::take_state(const CellView& view, bool whole, Time now) {
  const auto since = now - last_sent_;
  const bool goes_on = sequence_ != 0 && !whole;
  if (goes_on && since < options_.state_spacing) return false;
  if (goes_on && since < options_.beat && view.state == state_) return false;
  ++sequence_;
  if (whole) state_begin_ = sequence_;
  live_.take(view.state, sequence_, whole);
  made_.clear();
  state_ = view.state;
  last_sent_ = now;
  return true;
}

bool Feed::take_plan(const CellView& view) {
  if (!view.plan || *view.plan == plan_source_ || view.plan->size() > options_.max_plan_bytes) return false;
  plan_source_ = *view.plan;
  auto parts = protocol::plan_parts(plan_source_);
  if (!parts) return false;
  take_routes(std::move(parts->routes));
  plan_ = shared(protocol::with_revision(parts->plan, ++plan_revision_));
  return true;
}

void Feed::take_routes(std::string routes) {
  if (routes.empty() || routes == routes_source_) return;
  routes_source_ = std::move(routes);
  routes_ = shared(protocol::with_revision(routes_source_, ++routes_revision_));
}

bool Feed::take_pictures(const CellView& view) {
  if (!view.pictures || *view.pictures == pictures_source_) return false;
  pictures_source_ = *view.pictures;
  const auto message = protocol::pictures_message(pictures_source_);
  if (!message) return false;
  pictures_ = shared(protocol::with_revision(*message, ++pictures_revision_));
  return true;
}

bool Feed::take_trend(const protocol::CellState& state, Time now) {
  if (trend_points_.empty() || !state.runtime_alive || now - last_trend_ < options_.trend_spacing) {
    return false;
  }
  const auto before = std::pair(trend_.run(), trend_.end());
  protocol::TrendRow row{state.time_s, {}};
  for (const std::size_t point : trend_points_) row.values.push_back(state.points.at(point));
  const bool empty = std::none_of(row.values.begin(), row.values.end(), [](auto v) { return v.has_value(); });
  if (empty) return false;
  trend_.add(std::move(row));
  if (before == std::pair(trend_.run(), trend_.end())) return false;
  last_trend_ = now;
  return true;
}

void Feed::set_alarms(const std::string& message) {
  const std::lock_guard lock(mutex_);
  alarms_ = shared(protocol::with_revision(message, ++alarms_revision_));
}

std::optional<std::string> Feed::hear(Cursor& cursor, std::string_view text) const {
  auto message = protocol::read_viewer_message(text);
  if (!message) return message.error();
  if (message->begins == cursor.begun) return "a page begins once, and before all else";
  if (message->begins && message->protocol != protocol::kProtocolVersion)
    return "protocol " + std::to_string(protocol::kProtocolVersion) + " is spoken here";
  const std::lock_guard lock(mutex_);
  if (auto why = refusal(message->show.tags)) return why;
  cursor.shown = false;
  cursor.show = std::move(message->show);
  if (message->begins && message->epoch == epoch_) go_on(cursor, message->has);
  cursor.begun = true;
  return std::nullopt;
}

// What the viewer has of this run it does not get again.
void Feed::go_on(Cursor& cursor, const protocol::ViewerState& has) const {
  cursor.state = known(has.sequence, sequence_);
  cursor.shown = has.tags && cursor.state != 0;
  cursor.program = known(has.program, program_revision_);
  cursor.plan = known(has.plan, plan_revision_);
  cursor.routes = known(has.routes, routes_revision_);
  cursor.pictures = known(has.pictures, pictures_revision_);
  cursor.alarms = known(has.alarms, alarms_revision_);
  cursor.forces = known(has.forces, forces_revision_);
  const bool kept = has.trend_run == trend_.run() && has.trend_next >= trend_.begin() &&
                    has.trend_next <= trend_.end() && has.trend_next != 0;
  cursor.trend_begun = kept;
  cursor.trend_run = kept ? has.trend_run : 0;
  cursor.trend_row = kept ? has.trend_next : 0;
}

bool Feed::is_current(const protocol::TagChoice& tags) const {
  return layout_ != nullptr && tags.digest == layout_->program.digest;
}

// Of a program that has gone or is to come nothing is known, and nothing is sent.
std::optional<std::string> Feed::refusal(const protocol::TagChoice& tags) const {
  if (tags.ranges.empty() || !is_current(tags)) return std::nullopt;
  const protocol::TagRange& last = tags.ranges.back();
  if (std::size_t{last.first} + last.count <= layout_->program.tags.size()) return std::nullopt;
  return "the program has no such tag";
}

MessageText Feed::next(Cursor& cursor) const {
  if (!cursor.greeted) {
    cursor.greeted = true;
    return hello_;
  }
  if (!cursor.begun) return nullptr;
  const std::lock_guard lock(mutex_);
  if (cursor.program != program_revision_) {
    cursor.program = program_revision_;
    return program_;
  }
  if (sequence_ != 0 && (cursor.state != sequence_ || !cursor.shown)) return next_state(cursor);
  if (cursor.show.routes && cursor.routes != routes_revision_) {
    cursor.routes = routes_revision_;
    return routes_;
  }
  if (cursor.show.pictures && cursor.pictures != pictures_revision_) {
    cursor.pictures = pictures_revision_;
    return pictures_;
  }
  if (cursor.show.plan && cursor.plan != plan_revision_) {
    cursor.plan = plan_revision_;
    return plan_;
  }
  if (cursor.alarms != alarms_revision_) {
    cursor.alarms = alarms_revision_;
    return alarms_;
  }
  if (cursor.forces != forces_revision_) {
    cursor.forces = forces_revision_;
    return forces_;
  }
  return cursor.show.trend ? next_trend(cursor) : nullptr;
}

void Feed::set_forces(const std::string& list) {
  // The list is an object of our own: its type goes in front of its members.
  const std::lock_guard lock(mutex_);
  forces_ = shared(protocol::with_revision("{\"type\":\"forces\"," + list.substr(1), ++forces_revision_));
}

MessageText Feed::next_state(Cursor& cursor) const {
  protocol::StateRequest request;
  if (cursor.state >= state_begin_) request.since = cursor.state;
  if (cursor.show.tags.all || is_current(cursor.show.tags)) request.tags = cursor.show.tags;
  request.tags.digest.clear();
  if (!cursor.shown) request.show = cursor.show.number;
  cursor.state = sequence_;
  cursor.shown = true;
  // Viewers that keep up and want the same share one text.
  const auto found =
      std::find_if(made_.begin(), made_.end(), [&](const auto& made) { return made.first == request; });
  if (found != made_.end()) return found->second;
  auto text = shared(live_.message(request));
  constexpr std::size_t kMostKept = 64;
  if (made_.size() < kMostKept) made_.emplace_back(std::move(request), text);
  return text;
}

MessageText Feed::next_trend(Cursor& cursor) const {
  // Rows between that are no longer kept would be a hole.
  const bool restart =
      !cursor.trend_begun || cursor.trend_run != trend_.run() || cursor.trend_row < trend_.begin();
  if (restart) cursor.trend_row = 0;
  if (cursor.trend_row >= trend_.end()) return nullptr;
  const auto rows = trend_.rows(cursor.trend_row, options_.trend_rows_per_message);
  const protocol::TrendPiece piece{trend_.run(), cursor.trend_row, restart};
  cursor.trend_row += rows.size();
  cursor.trend_run = trend_.run();
  cursor.trend_begun = true;
  return shared(protocol::trend_message(rows, piece));
}

}  // namespace stepwright::server
