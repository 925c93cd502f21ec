#include <charconv>

#include "hmi_web/access/audit_chain.h"
#include "hmi_web/access/audit_text.h"
#include "hmi_web/access/durable_file.h"
#include "hmi_web/api/routes.h"

namespace stepwright::api {
namespace {

constexpr std::size_t kMostOnAPage = 200;

Route row(const char* path, const char* name, const char* summary, const char* answer, const char* type) {
  Route route = reading_row(path, name, summary, answer);
  route.least = Role::Engineer;
  route.lane = Lane::Quick;
  route.answer_type = type;
  return route;
}

Answer with_text(const access::AuditLog& audit, const std::function<Answer(std::string)>& make) {
  auto text = access::read_whole(audit.file());
  if (!text) return refused(text.error());
  // A line that is being written at this moment has no end yet.
  text->resize(text->rfind('\n') + 1);
  return make(std::move(*text));
}

Answer file_answer(std::string text, const char* type, const char* name) {
  Answer answer;
  answer.text = std::move(text);
  answer.content_type = type;
  answer.file_name = name;
  return answer;
}

Answer page_of(const std::string& text, const std::string& before) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(before.data(), before.data() + before.size(), number);
  if (!before.empty() && (error != std::errc() || end != before.data() + before.size()))
    return refused(400, "H0033", "'before' is no number of an entry", "for example ?before=120");
  const access::ChainCheck check = access::check_chain(text);
  Answer answer;
  answer.text = "{\"entries\":" + access::newest_entries(text, kMostOnAPage, number) +
                ",\"count\":" + std::to_string(check.entries) + ",\"head\":\"" + check.head +
                "\",\"broken_line\":" + std::to_string(check.broken_line) + "}";
  return answer;
}

}  // namespace

std::vector<Route> audit_routes(const Services& services) {
  const access::AuditLog* audit = services.audit;
  Route page = row("/api/audit", "audit.read", "The newest 200 entries, and whether the chain holds",
                   R"({"type": "object", "required": ["entries", "count", "head", "broken_line"],
  "properties": {"entries": {"type": "array", "items": {"type": "object"}}, "count": {"type": "integer"},
                 "head": {"type": "string"}, "broken_line": {"type": "integer", "description": "0: none"}}})",
                   "application/json");
  page.query = {{"before", "only entries with a smaller number"}};
  page.handler = [audit](const Call& call) {
    const std::string before = call.parameter("before");
    return with_text(*audit, [&](const std::string& text) { return page_of(text, before); });
  };
  Route lines =
      row("/api/audit/audit.jsonl", "audit.export_lines", "The whole trail as it is kept, one entry a line",
          R"({"type": "string"})", "application/x-ndjson");
  lines.handler = [audit](const Call&) {
    return with_text(*audit, [](std::string text) {
      return file_answer(std::move(text), "application/x-ndjson", "audit.jsonl");
    });
  };
  Route table = row("/api/audit/audit.csv", "audit.export_table", "The whole trail as a table (RFC 4180)",
                    R"({"type": "string"})", "text/csv");
  table.handler = [audit](const Call&) {
    return with_text(*audit, [](const std::string& text) {
      return file_answer(access::entries_csv(text), "text/csv; charset=utf-8", "audit.csv");
    });
  };
  return {page, lines, table};
}

}  // namespace stepwright::api
