#include "hmi_web/protocol/messages.h"

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

// The fields that are sent whole whenever they change, in both kinds of message.
json scalar_fields(const CellState& state) {
  return {{"runtime_alive", state.runtime_alive},
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
          {"transitions", state.true_transitions}};
}

json changed_values(const std::vector<std::optional<double>>& before,
                    const std::vector<std::optional<double>>& now) {
  json changes = json::object();
  for (std::size_t i = 0; i < now.size(); ++i) {
    json value = number(now[i]);
    if (i >= before.size() || number(before[i]) != value) changes[std::to_string(i)] = std::move(value);
  }
  return changes;
}

}  // namespace

std::string program_message(const Program& program) {
  json steps = json::array();
  for (const auto& step : program.steps) {
    steps.push_back({{"name", step.name}, {"comment", step.comment}, {"initial", step.initial}});
  }
  json transitions = json::array();
  for (const auto& transition : program.transitions) {
    transitions.push_back({{"name", transition.name},
                           {"from", transition.sources},
                           {"to", transition.targets},
                           {"condition", transition.condition}});
  }
  json charts = json::array();
  for (const auto& chart : program.charts) {
    charts.push_back({{"name", chart.name}, {"steps", chart.steps}, {"transitions", chart.transitions}});
  }
  json tags = json::array();
  for (const auto& tag : program.tags) {
    tags.push_back({{"name", tag.name}, {"type", tag.type}, {"address", tag.address}});
  }
  return text({{"type", "program"},
               {"digest", program.digest},
               {"charts", std::move(charts)},
               {"steps", std::move(steps)},
               {"transitions", std::move(transitions)},
               {"tags", std::move(tags)}});
}

std::string state_message(const CellState& state, std::uint64_t sequence) {
  json message = scalar_fields(state);
  message["type"] = "state";
  message["seq"] = sequence;
  message["points"] = numbers(state.points);
  message["tags"] = numbers(state.tags);
  return text(message);
}

std::string delta_message(const CellState& before, const CellState& now, std::uint64_t sequence) {
  json message = scalar_fields(now);
  const json old = scalar_fields(before);
  for (const auto& [key, value] : old.items()) {
    if (message[key] == value) message.erase(key);
  }
  json points = changed_values(before.points, now.points);
  if (!points.empty()) message["points"] = std::move(points);
  json tags = changed_values(before.tags, now.tags);
  if (!tags.empty()) message["tags"] = std::move(tags);
  message["type"] = "delta";
  message["seq"] = sequence;
  return text(message);
}

std::string trend_message(std::span<const TrendRow> rows, std::uint64_t first, bool restart) {
  json list = json::array();
  for (const auto& row : rows) {
    json values = numbers(row.values);
    values.insert(values.begin(), number(row.time_s));
    list.push_back(std::move(values));
  }
  return text({{"type", "trend"}, {"first", first}, {"restart", restart}, {"rows", std::move(list)}});
}

}  // namespace stepwright::protocol
