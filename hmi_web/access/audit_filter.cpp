#include "hmi_web/access/audit_filter.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "hmi_web/access/audit_text.h"
#include "runtime/ground/naming/folded_text.h"

namespace stepwright::access {
namespace {

using naming::folded;
using nlohmann::json;

constexpr std::array kSearched = {"action", "target", "before", "after",  "reason",
                                  "result", "user",   "role",   "address"};

std::string text_of(const json& entry, const char* member) {
  const auto found = entry.find(member);
  return found != entry.end() && found->is_string() ? folded(found->get<std::string>()) : std::string();
}

class Matcher {
 public:
  explicit Matcher(const AuditFilter& filter)
      : user_(folded(filter.user)), target_(folded(filter.target)), text_(folded(filter.text)) {
    // The times of entries compare as texts.
    if (filter.from_ms) from_ = utc_text(*filter.from_ms);
    if (filter.to_ms) to_ = utc_text(*filter.to_ms);
  }

  bool operator()(std::string_view line) const {
    const json entry = json::parse(line, nullptr, /*allow_exceptions=*/false);
    if (!entry.is_object()) return false;
    if (!user_.empty() && text_of(entry, "user").find(user_) == std::string::npos) return false;
    if (!target_.empty() && text_of(entry, "target").find(target_) == std::string::npos) return false;
    const std::string time = entry.value("time", std::string());
    if ((!from_.empty() && time < from_) || (!to_.empty() && time > to_)) return false;
    return text_.empty() || std::ranges::any_of(kSearched, [&](const char* member) {
             return text_of(entry, member).find(text_) != std::string::npos;
           });
  }

 private:
  std::string user_, target_, text_, from_, to_;
};

}  // namespace

std::string matching_lines(std::string_view lines, const AuditFilter& filter) {
  const Matcher matches(filter);
  std::string kept;
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size() - 1) + 1;
    const std::string_view line = lines.substr(0, end);
    if (matches(line)) kept += line;
    lines.remove_prefix(end);
  }
  return kept;
}

}  // namespace stepwright::access
