#include "hmi_web/api/internal/supervisor_row.h"

#include <utility>

namespace stepwright::api {

using nlohmann::json;

namespace {

const Field kReason{
    .name = "reason", .required = false, .most = 200, .description = "why, for the audit trail"};

}  // namespace

Field text_field(const char* name, double most, const char* description) {
  return {.name = name, .least = 1, .most = most, .description = description};
}

Answer accepted(const result::Result<void>& done, std::string target, std::string after) {
  Answer answer;
  if (!done) answer = refused(done.error());
  if (done) answer = {.status = 200, .text = R"({"accepted": true})"};
  answer.target = std::move(target);
  answer.after = std::move(after);
  return answer;
}

Route supervisor_row(CellControl* cell, const char* path, const char* name, const char* summary, Shape shape,
                     const std::function<json(const Body&)>& request) {
  Route route = acting_row(
      "POST", path, name, summary,
      R"({"type": "object", "required": ["accepted"], "properties": {"accepted": {"type": "boolean",
    "description": "whoever was asked has agreed; a supervisor obeys at its next decision"}}})");
  route.least = Role::Operator;
  route.lane = Lane::Runtime;
  route.body = std::move(shape);
  route.body.fields.push_back(kReason);
  route.handler = [cell, request](const Call& call) {
    const std::string text = request(call.body).dump(-1, ' ', false, json::error_handler_t::replace);
    const std::string& named = call.body.text("name");
    return accepted(cell->ask_supervisor(text), named.empty() ? call.body.text("vehicle") : named, text);
  };
  return route;
}

}  // namespace stepwright::api
