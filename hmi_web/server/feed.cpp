#include "hmi_web/server/feed.h"

#include <algorithm>
#include <utility>

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

}  // namespace

Feed::Feed(const protocol::Greeting& greeting, const protocol::Synoptic& synoptic, const FeedOptions& options)
    : options_(options),
      hello_(shared(protocol::hello_message(greeting, synoptic))),
      trend_points_(trend_points(synoptic)),
      trend_(options.trend_rows) {}

bool Feed::update(const CellView& view, Time now) {
  const std::lock_guard lock(mutex_);
  const bool program = take_program(view);
  const bool state = take_state(view, program, now);
  const bool plan = take_plan(view);
  const bool trend = take_trend(view.state, now);
  return program || state || plan || trend;
}

bool Feed::take_program(const CellView& view) {
  if (view.layout == layout_) return false;
  layout_ = view.layout;
  program_ = shared(protocol::program_message(layout_ ? layout_->program : protocol::Program{}));
  ++program_revision_;
  return true;
}

bool Feed::take_state(const CellView& view, bool whole, Time now) {
  const bool beat = now - last_sent_ >= options_.beat;
  if (sequence_ != 0 && !whole && !beat && view.state == state_) return false;
  ++sequence_;
  delta_ = whole || sequence_ == 1 ? nullptr : shared(protocol::delta_message(state_, view.state, sequence_));
  state_ = view.state;
  whole_ = nullptr;
  last_sent_ = now;
  return true;
}

bool Feed::take_plan(const CellView& view) {
  if (!view.plan || *view.plan == plan_source_ || view.plan->size() > options_.max_plan_bytes) return false;
  plan_source_ = *view.plan;
  auto parts = protocol::plan_parts(plan_source_);
  if (!parts) return false;
  take_routes(std::move(parts->routes));
  plan_ = shared(std::move(parts->plan));
  ++plan_revision_;
  return true;
}

void Feed::take_routes(std::string routes) {
  if (routes.empty() || (routes_ && *routes_ == routes)) return;
  routes_ = shared(std::move(routes));
  ++routes_revision_;
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

void Feed::set_alarms(std::string message) {
  const std::lock_guard lock(mutex_);
  alarms_ = shared(std::move(message));
  ++alarms_revision_;
}

MessageText Feed::next(Cursor& cursor) const {
  if (!cursor.greeted) {
    cursor.greeted = true;
    return hello_;
  }
  const std::lock_guard lock(mutex_);
  if (cursor.program != program_revision_) {
    cursor.program = program_revision_;
    return program_;
  }
  if (cursor.state != sequence_) return next_state(cursor);
  if (cursor.routes != routes_revision_) {
    cursor.routes = routes_revision_;
    return routes_;
  }
  if (cursor.plan != plan_revision_) {
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
  return next_trend(cursor);
}

void Feed::set_forces(const std::string& list) {
  // The list is an object of our own: its type goes in front of its members.
  const std::lock_guard lock(mutex_);
  forces_ = shared("{\"type\":\"forces\"," + list.substr(1));
  ++forces_revision_;
}

MessageText Feed::next_state(Cursor& cursor) const {
  const bool has_previous = cursor.state + 1 == sequence_;
  cursor.state = sequence_;
  if (has_previous && delta_) return delta_;
  if (!whole_) whole_ = shared(protocol::state_message(state_, sequence_));
  return whole_;
}

MessageText Feed::next_trend(Cursor& cursor) const {
  const bool restart = !cursor.trend_begun || cursor.trend_run != trend_.run();
  if (restart) cursor.trend_row = 0;
  if (cursor.trend_row >= trend_.end()) return nullptr;
  const auto rows = trend_.rows(cursor.trend_row, options_.trend_rows_per_message);
  const std::uint64_t first = cursor.trend_row;
  cursor.trend_row += rows.size();
  cursor.trend_run = trend_.run();
  cursor.trend_begun = true;
  return shared(protocol::trend_message(rows, first, restart));
}

}  // namespace stepwright::server
