#include "hmi_web/protocol/live_state.h"

#include <algorithm>
#include <array>

#include "hmi_web/protocol/json_text.h"

namespace stepwright::protocol {
namespace {

using nlohmann::json;

json to_json(const ScanFigures& figures) {
  return {{"overruns", figures.overruns},
          {"p50_us", number(figures.p50_us)},
          {"p99_us", number(figures.p99_us)},
          {"max_us", number(figures.max_us)},
          {"realtime_factor", number(figures.realtime_factor)}};
}

// Of ascending indices: ranges [first, count].
json ranges_of(const std::vector<std::uint32_t>& indices) {
  json ranges = json::array();
  for (std::size_t i = 0; i < indices.size();) {
    std::size_t end = i + 1;
    while (end < indices.size() && indices[end] == indices[i] + (end - i)) ++end;
    ranges.push_back({indices[i], end - i});
    i = end;
  }
  return ranges;
}

json to_json(const std::vector<UnreadDevice>& unread) {
  json list = json::array();
  for (const UnreadDevice& one : unread)
    list.push_back({{"device", one.device}, {"why", to_string(one.why)}, {"tags", ranges_of(one.tags)}});
  return list;
}

// What travels whole whenever it changes.
std::array<std::pair<const char*, json>, 14> whole_fields(const CellState& state) {
  return {{{"runtime_alive", state.runtime_alive},
           {"runtime_unlinked", state.runtime_unlinked},
           {"supervisor_alive", state.supervisor_alive},
           {"runtime_state", state.runtime_state},
           {"runtime_detail", state.runtime_detail},
           {"waiting", state.waiting},
           {"program", state.program_digest},
           {"scan", state.scan},
           {"time_s", number(state.time_s)},
           {"trace_hash", state.trace_hash},
           {"figures", to_json(state.figures)},
           {"steps", state.active_steps},
           {"transitions", state.true_transitions},
           {"unread", to_json(state.unread)}}};
}

}  // namespace

const char* to_string(Unread why) {
  switch (why) {
    case Unread::Lost:
      return "lost";
    case Unread::Never:
      return "never";
    case Unread::Untold:
      break;
  }
  return "untold";
}

void LiveState::take_points(const std::vector<std::optional<double>>& values, std::uint64_t sequence,
                            std::vector<Number>& kept) {
  kept.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    Number& number = kept[i];
    if (number.changed != 0 && number.value == values[i]) continue;
    number.value = values[i];
    number.take_text(measured_text(values[i]), sequence);
  }
}

void LiveState::take_tags(const CellState& now, std::uint64_t sequence, std::vector<Number>& kept) {
  kept.resize(now.tags.size());
  auto next = now.texts.begin();
  auto real = now.reals.begin();
  for (std::size_t i = 0; i < now.tags.size(); ++i) {
    Number& number = kept[i];
    const bool is_text = next != now.texts.end() && next->first == i;
    const bool is_real = real != now.reals.end() && *real == i;
    if (is_real) ++real;
    if (number.changed != 0 && !is_text && !number.is_text && number.value == now.tags[i]) continue;
    number.value = now.tags[i];
    number.is_text = is_text;
    number.take_text(is_text ? text(json(next++->second)) : value_text(now.tags[i], is_real), sequence);
  }
}

void LiveState::Number::take_text(std::string fresh, std::uint64_t sequence) {
  if (changed != 0 && text == fresh) return;
  text = std::move(fresh);
  changed = sequence;
}

void LiveState::take(const CellState& now, std::uint64_t sequence, bool anew) {
  sequence_ = sequence;
  const auto fields = whole_fields(now);
  fields_.resize(fields.size());
  for (std::size_t i = 0; i < fields.size(); ++i) {
    std::string fresh = text(fields[i].second);
    if (fields_[i].changed != 0 && fields_[i].text == fresh) continue;
    fields_[i] = {fields[i].first, std::move(fresh), sequence};
  }
  if (anew) tags_.clear();
  take_points(now.points, sequence, points_);
  take_tags(now, sequence, tags_);
}

// "3":1.5,"7":null, - with a comma behind each.
void LiveState::append(const std::vector<Number>& numbers, TagRange range, std::uint64_t since,
                       std::string& text) {
  const std::size_t end = std::min<std::size_t>(numbers.size(), std::size_t{range.first} + range.count);
  for (std::size_t i = range.first; i < end; ++i) {
    if (numbers[i].changed <= since) continue;
    text += '"';
    text += std::to_string(i);
    text += "\":";
    text += numbers[i].text;
    text += ',';
  }
}

void LiveState::append_tags(const StateRequest& request, std::string& text) const {
  const bool whole = request.since == 0 || request.show.has_value();
  const std::size_t begin = text.size();
  text += "\"tags\":{";
  const std::size_t empty = text.size();
  const std::uint64_t since = whole ? 0 : request.since;
  if (request.tags.all) {
    append(tags_, {0, static_cast<std::uint32_t>(tags_.size())}, since, text);
  } else {
    for (const TagRange& range : request.tags.ranges) append(tags_, range, since, text);
  }
  if (text.size() > empty) {
    text.back() = '}';
    text += ',';
  } else if (whole) {
    text += "},";
  } else {
    text.resize(begin);
  }
}

void LiveState::append_points(std::uint64_t since, std::string& text) const {
  const std::size_t begin = text.size();
  text += since == 0 ? "\"points\":[" : "\"points\":{";
  const std::size_t empty = text.size();
  if (since == 0) {
    for (const Number& point : points_) text += point.text + ',';
    if (text.size() > empty) text.pop_back();
    text += "],";
    return;
  }
  append(points_, {0, static_cast<std::uint32_t>(points_.size())}, since, text);
  if (text.size() == empty) return text.resize(begin);
  text.back() = '}';
  text += ',';
}

std::string LiveState::message(const StateRequest& request) const {
  std::string text = request.since == 0 ? "{\"type\":\"state\"," : "{\"type\":\"delta\",";
  if (request.show) text += "\"show\":" + std::to_string(*request.show) + ',';
  for (const Field& field : fields_) {
    if (field.changed <= request.since) continue;
    text += '"' + field.name + "\":" + field.text + ',';
  }
  append_points(request.since, text);
  append_tags(request, text);
  return text + "\"seq\":" + std::to_string(sequence_) + '}';
}

}  // namespace stepwright::protocol
