#include <charconv>

#include "hmi_web/access/audit_chain.h"
#include "hmi_web/access/audit_files.h"
#include "hmi_web/access/audit_text.h"
#include "hmi_web/api/routes.h"

namespace stepwright::api {
namespace {

constexpr access::MostLines kOnAPage{200, std::size_t{1} << 20};
constexpr access::MostLines kInAFile{20'000, std::size_t{16} << 20};

Route row(const char* path, const char* name, const char* summary, const char* answer, const char* type) {
  Route route = reading_row(path, name, summary, answer);
  route.least = Role::Engineer;
  route.lane = Lane::Quick;
  route.answer_type = type;
  return route;
}

// The number of an entry that all others are to be below; 0: from the newest on.
result::Result<std::uint64_t> before_of(const Call& call) {
  const std::string& before = call.parameter("before");
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(before.data(), before.data() + before.size(), number);
  if (before.empty() || (error == std::errc() && end == before.data() + before.size())) return number;
  return result::fail("H0033", {}, "'before' is no number of an entry", "for example ?before=120");
}

Answer with_lines(const access::AuditLog& audit, const Call& call, const access::MostLines& most,
                  const std::function<Answer(std::string)>& make) {
  const auto before = before_of(call);
  if (!before) return refused(400, before.error());
  auto lines = access::lines_before(audit.file(), *before, most);
  if (!lines) return refused(lines.error());
  return make(std::move(*lines));
}

Answer file_answer(std::string text, const char* type, const char* name) {
  Answer answer;
  answer.text = std::move(text);
  answer.content_type = type;
  answer.file_name = name;
  return answer;
}

Answer page_of(const access::AuditLog& audit, const std::string& lines) {
  const auto start = access::start_of(lines);
  const access::ChainCheck check = access::check_chain(lines, start.value_or(access::ChainStart{}));
  Answer answer;
  answer.text = "{\"entries\":" + access::newest_entries(lines, kOnAPage.lines) +
                ",\"count\":" + std::to_string(audit.entries()) + ",\"head\":\"" + audit.head() +
                "\",\"broken_line\":" + std::to_string(check.broken_line) + "}";
  return answer;
}

}  // namespace

std::vector<Route> audit_routes(const Services& services) {
  const access::AuditLog* audit = services.audit;
  const std::vector<Parameter> before = {{"before", "only entries with a smaller number"}};
  Route page = row("/api/audit", "audit.read", "The newest 200 entries, and whether their chain holds",
                   R"({"type": "object", "required": ["entries", "count", "head", "broken_line"],
  "properties": {"entries": {"type": "array", "items": {"type": "object"}},
                 "count": {"type": "integer", "description": "number of the newest entry of all"},
                 "head": {"type": "string", "description": "its hash"},
                 "broken_line": {"type": "integer", "description": "number of the first wrong one of these; 0: none"}}})",
                   "application/json");
  page.query = before;
  page.handler = [audit](const Call& call) {
    return with_lines(*audit, call, kOnAPage,
                      [&](const std::string& lines) { return page_of(*audit, lines); });
  };
  Route lines = row("/api/audit/audit.jsonl", "audit.export_lines",
                    "The newest 20,000 entries as they are kept, one a line", R"({"type": "string"})",
                    "application/x-ndjson");
  lines.query = before;
  lines.handler = [audit](const Call& call) {
    return with_lines(*audit, call, kInAFile, [](std::string text) {
      return file_answer(std::move(text), "application/x-ndjson", "audit.jsonl");
    });
  };
  Route table = row("/api/audit/audit.csv", "audit.export_table",
                    "The newest 20,000 entries as a table (RFC 4180)", R"({"type": "string"})", "text/csv");
  table.query = before;
  table.handler = [audit](const Call& call) {
    return with_lines(*audit, call, kInAFile, [](const std::string& text) {
      return file_answer(access::entries_csv(text), "text/csv; charset=utf-8", "audit.csv");
    });
  };
  return {page, lines, table};
}

}  // namespace stepwright::api
