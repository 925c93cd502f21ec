#include <nlohmann/json.hpp>

#include "hmi_web/api/internal/service_row.h"
#include "hmi_web/api/routes.h"
#include "hmi_web/trends/trend_store.h"

namespace stepwright::api {
namespace {

using nlohmann::json;
using trends::TrendGroup;
using trends::TrendStore;

const Field kTags{.name = "tags",
                  .kind = Kind::List,
                  .least = 1,
                  .most = static_cast<double>(trends::kMostSeries),
                  .longest = trends::kLongestTag,
                  .description = "names as the history has them, in their order"};
const Field kAxes{.name = "axes",
                  .kind = Kind::Texts,
                  .required = false,
                  .most = static_cast<double>(trends::kMostSeries),
                  .longest = trends::kLongestAxis,
                  .description = "of tags with an axis of their own: \"own\", or its ends as \"0..100\""};
const Field kSpan{.name = "span_s",
                  .kind = Kind::Number,
                  .least = 0.1,
                  .most = 400.0 * 86'400,
                  .description = "how long a time is shown"};

constexpr const char* kGroups = R"({"type": "object", "required": ["groups"], "properties": {"groups":
  {"type": "array", "items": {"type": "object", "required": ["name", "tags", "axes", "span_s", "saved_by", "saved_ms"],
    "properties": {"name": {"type": "string"}, "tags": {"type": "array", "items": {"type": "string"}},
      "axes": {"type": "object", "additionalProperties": {"type": "string"}}, "span_s": {"type": "number"},
      "saved_by": {"type": "string"}, "saved_ms": {"type": "integer"}}}}}})";
constexpr const char* kName =
    R"({"type": "object", "required": ["name"], "properties": {"name": {"type": "string"}}})";

Answer no_trends() {
  return no_records();
}

json described(const TrendGroup& group) {
  json tags = json::array();
  json axes = json::object();
  for (const trends::TrendSeries& each : group.series) {
    tags.push_back(each.tag);
    if (!each.axis.empty()) axes[each.tag] = each.axis;
  }
  const auto saved = std::chrono::duration_cast<std::chrono::milliseconds>(group.saved.time_since_epoch());
  return {{"name", group.name},     {"tags", std::move(tags)},    {"axes", std::move(axes)},
          {"span_s", group.span_s}, {"saved_by", group.saved_by}, {"saved_ms", saved.count()}};
}

std::string text_of(const json& document) {
  return document.dump(-1, ' ', false, json::error_handler_t::replace);
}

// For the audit trail: its tags.
std::string told(const TrendGroup& group) {
  std::string text;
  for (const trends::TrendSeries& each : group.series)
    text += (text.empty() ? "" : "; ") + each.tag + (each.axis.empty() ? "" : " (" + each.axis + ")");
  return text;
}

Answer list_of(const TrendStore& store) {
  json list = json::array();
  for (const TrendGroup& group : store.list()) list.push_back(described(group));
  return Answer{.text = text_of({{"groups", std::move(list)}})};
}

Answer save_in(TrendStore& store, const Call& call) {
  TrendGroup group{.name = call.parameter("name"),
                   .series = {},
                   .span_s = call.body.number("span_s"),
                   .saved_by = call.who.user,
                   .saved = std::chrono::system_clock::now()};
  const Body::Texts& axes = call.body.texts("axes");
  for (const std::string& tag : call.body.list("tags")) {
    const auto axis = axes.find(tag);
    group.series.push_back({tag, axis == axes.end() ? std::string() : axis->second});
  }
  const auto before = store.save(group);
  Answer answer = before ? Answer{.text = text_of({{"name", group.name}})} : refused(before.error());
  answer.target = group.name;
  answer.after = told(group);
  if (before && *before) answer.before = told(**before);
  return answer;
}

Answer remove_from(TrendStore& store, const Call& call) {
  const std::string& name = call.parameter("name");
  const auto before = store.remove(name);
  Answer answer = before ? Answer{.text = text_of({{"name", name}})} : refused(before.error());
  answer.target = name;
  if (before) answer.before = told(*before);
  return answer;
}

}  // namespace

std::vector<Route> trend_routes(const Services& services) {
  Route save =
      acting_row("PUT", "/api/trends/{name}", "trend.save", "Saves a group of trends, or replaces it", kName);
  save.least = Role::Operator;
  save.body = {"SaveTrend", {kTags, kAxes, kSpan}};
  Route remove =
      acting_row("DELETE", "/api/trends/{name}", "trend.remove", "Removes a group of trends", kName);
  remove.least = Role::Operator;
  return {
      with_service(
          services.trends,
          reading_row("/api/trends", "trend.list",
                      "Groups of trends that are saved for everybody, and who saved them when", kGroups),
          no_trends, [](TrendStore& store, const Call&) { return list_of(store); }),
      with_service(services.trends, std::move(save), no_trends, save_in),
      with_service(services.trends, std::move(remove), no_trends, remove_from),
  };
}

}  // namespace stepwright::api
