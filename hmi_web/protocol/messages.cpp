#include "hmi_web/protocol/messages.h"

#include "hmi_web/protocol/json_text.h"
#include "hmi_web/protocol/tag_note_json.h"

namespace stepwright::protocol {

using nlohmann::json;

namespace {

constexpr std::size_t kMostLeftOut = 100;  // names of arrays

}  // namespace

std::string program_message(const Program& program, const PointTags& points) {
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
    if (!tag.comment.empty()) tags.back()["comment"] = tag.comment;
    if (tag.enumeration) tags.back()["enumeration"] = *tag.enumeration;
    if (!tag.note.says_nothing()) tags.back()["note"] = to_json(tag.note);
  }
  json enumerations = json::array();
  for (const auto& enumeration : program.enumerations) {
    json names = json::object();
    for (const auto& [value, name] : enumeration) names[std::to_string(value)] = name;
    enumerations.push_back(std::move(names));
  }
  json left_out = json::array();
  for (const auto& array : program.left_out) {
    if (left_out.size() < kMostLeftOut) left_out.push_back({{"name", array.name}, {"values", array.values}});
  }
  return text({{"type", "program"},
               {"digest", program.digest},
               {"charts", std::move(charts)},
               {"steps", std::move(steps)},
               {"transitions", std::move(transitions)},
               {"tags", std::move(tags)},
               {"enumerations", std::move(enumerations)},
               {"left_out", std::move(left_out)},
               {"points", points}});
}

std::string trend_message(std::span<const TrendRow> rows, const TrendPiece& piece) {
  json list = json::array();
  for (const auto& row : rows) {
    json values = measured(row.values);
    values.insert(values.begin(), number(row.time_s));
    list.push_back(std::move(values));
  }
  return text({{"type", "trend"},
               {"run", piece.run},
               {"first", piece.first},
               {"restart", piece.restart},
               {"rows", std::move(list)}});
}

std::string with_revision(std::string_view object, std::uint64_t revision) {
  const std::string_view members = object.substr(1);
  return "{\"revision\":" + std::to_string(revision) + (members == "}" ? "" : ",") + std::string(members);
}

}  // namespace stepwright::protocol
