#pragma once

// One row of the route table: everything that the server does for anybody is such a row.
//
//   Route{.method = "POST", .path = "/api/plan/abort", .name = "plan.abort", .least = Role::Operator,
//         .summary = "Stops the plant safely", .body = {"Abort", {...}}, .handler = ...}
//
// Plain values. Threads: a handler is called by the thread of its lane, one call of a lane at a time.

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_web/access/role.h"
#include "hmi_web/api/body.h"
#include "runtime/ground/result/result.h"

namespace stepwright::api {

using access::Role;

// Handlers that may take long do not hold up those of another lane.
enum class Lane : std::uint8_t {
  Server,    // no handler: the server itself (files of the page, the WebSocket, metrics)
  Quick,     // memory and the disk
  Records,   // files that grow: seconds of reading. Pages ask by themselves, so that a session grows idle all
             // the same
  Password,  // a tenth of a second of hashing
  Runtime,   // up to five seconds, until a runtime answers
  Stop,      // the same for what brings the plant to rest: it waits behind nothing else
};

// Entries of a call in the audit trail; reading has none.
enum class Audit : std::uint8_t {
  None,
  After,   // one entry with the result
  Around,  // one before it happens and one with the result: a crash in between leaves a trace
  Later,   // the same two, but written while and after it happens: stopping never waits for a disk
};

// The caller of a route.
struct Caller {
  std::string user;  // empty: nobody has logged in
  Role role = Role::None;
  std::string token;  // of the session; empty: none
  std::string csrf;
  std::string address;
};

struct Call {
  Caller who;
  std::map<std::string, std::string, std::less<>> parameters;  // of the path and of the query
  Body body;

  const std::string& parameter(std::string_view name) const;
};

struct Answer {
  unsigned status = 200;
  std::string text = {};  // JSON unless the type says otherwise
  std::string content_type = "application/json";
  std::string file_name = {};   // to be kept as; empty: shown
  std::string set_cookie = {};  // the session's token; "-" takes the cookie away
  std::chrono::seconds retry_after{0};
  std::string etag = {};  // quoted; a caller who has this answer already is told so (304). Empty: none
  // For the audit trail.
  std::string refusal = {};  // code and sentence
  std::string target = {};
  std::string before = {};
  std::string after = {};
  std::string user = {};  // who it turned out to be, of a log-in
};

using Handler = std::function<Answer(const Call&)>;

struct Parameter {
  std::string name;
  std::string description;
};

struct Route {
  std::string method;  // "GET", "POST", "PUT", "DELETE"
  std::string path;    // "/api/users/{name}": a part in braces is any text without a slash
  std::string name;    // "user.remove": in the audit trail and as operationId
  Role least = Role::Administrator;
  bool csrf = true;  // the token of the session is needed; only what opens a session goes without
  Audit audit = Audit::None;
  Lane lane = Lane::Quick;
  std::string summary;
  Shape body = {};
  std::size_t most_body = 0;  // bytes; 0: as the server has it for all others. Read from those admitted only
  std::vector<Parameter> query = {};
  std::string answer = "{}";  // a JSON Schema of a 200's body
  std::string answer_type = "application/json";
  Handler handler = {};
};

// A row for viewers that look, without a handler. Pages ask by themselves, so that a session grows idle all
// the same (Lane::Records).
Route reading_row(const char* path, const char* name, const char* summary, const char* answer);
// A row that changes something, without a handler: in the audit trail before it happens and after.
Route acting_row(const char* method, const char* path, const char* name, const char* summary,
                 const char* answer);

// {"problems": [{code, message, hint, line, column}]}; of sources that are compiled also `file` and
// `severity`.
Answer refused(unsigned status, const result::Diagnostics& problems);
Answer refused(unsigned status, const std::string& code, const std::string& message,
               const std::string& hint = {});
// A row that brings the plant to rest: ahead of all others, and whatever the disk does.
Route stopping(Route route);

// The status that fits the code of a problem: 400, 404, 409, 503, 504.
Answer refused(const result::Diagnostics& problems);

}  // namespace stepwright::api
