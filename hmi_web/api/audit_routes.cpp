#include <algorithm>
#include <charconv>
#include <functional>
#include <optional>

#include "hmi_web/access/audit_chain.h"
#include "hmi_web/access/audit_files.h"
#include "hmi_web/access/audit_filter.h"
#include "hmi_web/access/audit_text.h"
#include "hmi_web/api/routes.h"
#include "runtime/ground/csv/csv_rows.h"

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

constexpr access::MostLines kAtATime{2'000, std::size_t{4} << 20};
constexpr std::uint64_t kMostSearched = 20'000;  // entries of one request

result::Result<std::optional<std::int64_t>> time_of(const Call& call, const char* name) {
  const std::string& text = call.parameter(name);
  if (text.empty()) return std::optional<std::int64_t>();
  double ms = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), ms);
  if (error == std::errc() && end == text.data() + text.size() && ms >= 0 && ms < 1e15)
    return std::optional<std::int64_t>(static_cast<std::int64_t>(ms));
  return result::fail("H0060", {}, std::string("'") + name + "' is no time", "milliseconds since 1970");
}

result::Result<access::AuditFilter> filter_of(const Call& call) {
  access::AuditFilter filter{
      call.parameter("user"), call.parameter("target"), call.parameter("text"), {}, {}};
  auto from = time_of(call, "from_ms");
  if (!from) return result::forward(from);
  auto to = time_of(call, "to_ms");
  if (!to) return result::forward(to);
  filter.from_ms = *from;
  filter.to_ms = *to;
  return filter;
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

// What a filter finds: whole lines in their order, and the number below which others may be; 0: there are
// none.
struct Found {
  std::string lines;
  std::uint64_t before = 0;
};

result::Result<Found> search(const access::AuditLog& audit, std::uint64_t before,
                             const access::AuditFilter& filter, std::size_t wanted) {
  Found found{{}, before};
  std::uint64_t searched = 0;
  while (searched < kMostSearched) {
    auto lines = access::lines_before(audit.file(), found.before, kAtATime);
    if (!lines) return result::forward(lines);
    const auto start = access::start_of(*lines);
    searched += static_cast<std::uint64_t>(std::count(lines->begin(), lines->end(), '\n'));
    found.lines = access::matching_lines(*lines, filter) + found.lines;
    // The oldest that was looked at: others are below it.
    found.before = start ? start->sequence + 1 : 0;
    if (found.before <= 1) {
      found.before = 0;
      break;
    }
    if (static_cast<std::size_t>(std::count(found.lines.begin(), found.lines.end(), '\n')) >= wanted) break;
  }
  return found;
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

// The newest that match; the chain is not checked, as lines between them are missing.
Answer filtered_page(const access::AuditLog& audit, const Call& call, const access::AuditFilter& filter) {
  const auto before = before_of(call);
  if (!before) return refused(400, before.error());
  const auto found = search(audit, *before, filter, kOnAPage.lines);
  if (!found) return refused(found.error());
  Answer answer;
  answer.text = "{\"entries\":" + access::newest_entries(found->lines, kMostSearched) +
                ",\"count\":" + std::to_string(audit.entries()) + ",\"head\":\"" + audit.head() +
                "\",\"broken_line\":0,\"next_before\":" + std::to_string(found->before) + "}";
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
                 "next_before": {"type": "integer", "description": "of a search: below it there may be more; 0: there are none"},
                 "broken_line": {"type": "integer", "description": "number of the first wrong one of these; 0: none"}}})",
                   "application/json");
  const std::vector<Parameter> filters = {
      {"user", "part of the name of who did it"},
      {"target", "part of what it was done to"},
      {"text", "part of anything else in it"},
      {"from_ms", "ms since 1970"},
      {"to_ms", "ms since 1970"},
  };
  page.query = before;
  page.query.insert(page.query.end(), filters.begin(), filters.end());
  page.handler = [audit](const Call& call) {
    const auto filter = filter_of(call);
    if (!filter) return refused(400, filter.error());
    if (!filter->is_empty()) return filtered_page(*audit, call, *filter);
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
      return file_answer(std::string(csv::kByteOrderMark) + access::entries_csv(text),
                         "text/csv; charset=utf-8", "audit.csv");
    });
  };
  return {page, lines, table};
}

}  // namespace stepwright::api
