#include "hmi_web/access/audit_chain.h"

#include <charconv>
#include <nlohmann/json.hpp>

#include "hmi_web/access/secrets.h"

namespace stepwright::access {
namespace {

using nlohmann::ordered_json;

constexpr std::string_view kHashMember = ",\"hash\":\"";
constexpr std::string_view kEnd = "\"}";
constexpr std::size_t kHashLength = 64;

std::string number_of(std::string_view line, std::string_view member) {
  const std::size_t at = line.find(member);
  if (at == std::string_view::npos) return {};
  const std::size_t from = at + member.size();
  return std::string(line.substr(from, line.find_first_of(",\"", from) - from));
}

// Empty if the line is the one that follows.
std::string fault_of(std::string_view line, std::uint64_t sequence, const std::string& previous_hash) {
  const std::size_t tail = kHashMember.size() + kHashLength + kEnd.size();
  if (line.size() < tail || !line.ends_with(kEnd) ||
      line.substr(line.size() - tail, kHashMember.size()) != kHashMember)
    return "it is no line of an audit trail";
  const std::string_view body = line.substr(0, line.size() - tail);
  const std::string_view hash = line.substr(line.size() - kEnd.size() - kHashLength, kHashLength);
  if (!body.starts_with("{\"seq\":") || number_of(body, "\"seq\":") != std::to_string(sequence))
    return "its number is not " + std::to_string(sequence);
  if (number_of(body, "\"prev\":\"") != previous_hash) return "it does not follow the line before it";
  if (sha256_hex(body) != hash) return "it is not what was written";
  return {};
}

}  // namespace

ChainLine chain_line(const AuditEntry& entry, std::uint64_t sequence, const std::string& time,
                     const std::string& previous_hash) {
  const ordered_json fields = {{"seq", sequence},        {"prev", previous_hash},  {"time", time},
                               {"user", entry.user},     {"role", entry.role},     {"address", entry.address},
                               {"action", entry.action}, {"target", entry.target}, {"before", entry.before},
                               {"after", entry.after},   {"reason", entry.reason}, {"result", entry.result}};
  std::string body = fields.dump(-1, ' ', true, ordered_json::error_handler_t::replace);
  body.pop_back();
  std::string hash = sha256_hex(body);
  return {body + std::string(kHashMember) + hash + std::string(kEnd) + "\n", hash};
}

std::string first_hash() {
  return std::string(kHashLength, '0');
}

std::uint64_t sequence_of(std::string_view line) {
  constexpr std::string_view kBegin = "{\"seq\":";
  std::uint64_t number = 0;
  if (line.starts_with(kBegin))
    std::from_chars(line.data() + kBegin.size(), line.data() + line.size(), number);
  return number;
}

std::optional<ChainStart> start_of(std::string_view text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  const std::uint64_t number = sequence_of(line);
  std::string previous = number_of(line, "\"prev\":\"");
  if (number == 0 || previous.size() != kHashLength) return std::nullopt;
  return ChainStart{number - 1, std::move(previous)};
}

ChainCheck check_chain(std::string_view text, const ChainStart& start) {
  ChainCheck check;
  check.entries = start.sequence;
  check.head = start.head;
  while (check.right_bytes < text.size()) {
    const std::size_t end = text.find('\n', check.right_bytes);
    const bool whole = end != std::string_view::npos;
    const std::string_view line = text.substr(check.right_bytes, whole ? end - check.right_bytes : end);
    check.why = whole ? fault_of(line, check.entries + 1, check.head) : "it has no end";
    if (!check.why.empty()) {
      check.broken_line = check.entries + 1;
      check.torn = !whole;
      return check;
    }
    ++check.entries;
    check.head = std::string(line.substr(line.size() - kEnd.size() - kHashLength, kHashLength));
    check.right_bytes = end + 1;
  }
  return check;
}

}  // namespace stepwright::access
