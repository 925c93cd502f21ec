#include "hmi_web/api/route.h"

#include <nlohmann/json.hpp>

#include "hmi_web/api/cell_codes.h"

namespace stepwright::api {
namespace {

using nlohmann::json;

unsigned status_of(const std::string& code) {
  if (code == "H0024" || code == "C0607" || code == "H0072") return 404;  // no such user, alarm, recipe
  if (code == "H0091") return 404;                                        // no such program
  if (code.starts_with("R003") || code == "H0092" || code == "H0093" || code == "H0095" || code == "H0097" ||
      code == "H0098")
    return 409;  // programs that cannot take over now
  if (code == "H0073" || code == "H0078" || code == "H0079" || code == "H0080") return 409;  // recipes
  if (code == "H0025" || code == "H0029" || code == "H0068" || code == kProgramJustChanged ||
      code == "D0003" || code == kAnotherProgram || code == "X0008" || code == "C0606")
    return 409;                     // not in this state
  if (code == "D0007") return 504;  // somebody has not answered
  if (code == "H0021" || code == kNobodyAnswers || code == "H0020")
    return 503;                              // somebody or something is missing
  if (code.starts_with("S000")) return 503;  // the file of a history or a journal
  return 400;
}

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
  json list = json::array();
  for (const auto& problem : problems) {
    json entry = {{"code", problem.code}, {"message", problem.message}};
    if (!problem.hint.empty()) entry["hint"] = problem.hint;
    if (problem.where.line > 0) {
      entry["line"] = problem.where.line;
      entry["column"] = problem.where.column;
    }
    list.push_back(std::move(entry));
  }
  Answer answer;
  answer.status = status;
  if (!problems.empty()) answer.refusal = problems.front().code + ": " + problems.front().message;
  answer.text = json{{"problems", std::move(list)}}.dump(-1, ' ', false, json::error_handler_t::replace);
  return answer;
}

Answer refused(unsigned status, const std::string& code, const std::string& message,
               const std::string& hint) {
  return refused(status, result::fail(code, {}, message, hint).value());
}

Answer refused(const result::Diagnostics& problems) {
  return refused(problems.empty() ? 500 : status_of(problems.front().code), problems);
}

}  // namespace stepwright::api
