#include "hmi_web/api/route.h"

#include <nlohmann/json.hpp>

#include "hmi_web/api/internal/problems_json.h"
#include "hmi_web/api/internal/refusal_status.h"

namespace stepwright::api {
namespace {

using nlohmann::json;

}  // namespace

const std::string& Call::parameter(std::string_view name) const {
  static const std::string kNone;
  const auto found = parameters.find(name);
  return found == parameters.end() ? kNone : found->second;
}

Route reading_row(const char* path, const char* name, const char* summary, const char* answer) {
  return {.method = "GET",
          .path = path,
          .name = name,
          .least = Role::Viewer,
          .csrf = false,
          .lane = Lane::Records,
          .summary = summary,
          .answer = answer};
}

Route acting_row(const char* method, const char* path, const char* name, const char* summary,
                 const char* answer) {
  return {.method = method,
          .path = path,
          .name = name,
          .audit = Audit::Around,
          .summary = summary,
          .answer = answer};
}

Route stopping(Route route) {
  route.lane = Lane::Stop;
  route.audit = Audit::Later;
  return route;
}

Answer refused(unsigned status, const result::Diagnostics& problems) {
  Answer answer;
  answer.status = status;
  if (!problems.empty()) answer.refusal = problems.front().code + ": " + problems.front().message;
  answer.text =
      json{{"problems", problems_json(problems)}}.dump(-1, ' ', false, json::error_handler_t::replace);
  return answer;
}

Answer refused(unsigned status, const std::string& code, const std::string& message,
               const std::string& hint) {
  return refused(status, result::fail(code, {}, message, hint).value());
}

Answer refused(const result::Diagnostics& problems) {
  return refused(problems.empty() ? 500 : refusal_status(problems.front().code), problems);
}

}  // namespace stepwright::api
