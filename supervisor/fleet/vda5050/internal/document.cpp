#include "supervisor/fleet/vda5050/internal/document.h"

#include <set>
#include <utility>
#include <vector>

#include "supervisor/fleet/vda5050/internal/meaning.h"
#include "supervisor/fleet/vda5050/internal/rule.h"

namespace stepwright::fleet::vda5050 {

namespace {

using nlohmann::json;

constexpr std::size_t kMostBytes = 4u << 20;
constexpr std::size_t kMostLevels = 32;

result::Location place_of(std::string_view text, std::size_t byte, const std::string& source) {
  result::Location place{source, 1, 1};
  for (const char c : text.substr(0, byte == 0 ? 0 : byte - 1)) {
    ++place.column;
    if (c != '\n') continue;
    ++place.line;
    place.column = 1;
  }
  return place;
}

// Stops the reading; never leaves this file.
struct Refused {
  std::string message;
};

// What the parser would take: too many levels, a name that comes twice.
class Watch {
 public:
  bool operator()(int, json::parse_event_t event, const json& parsed) {
    switch (event) {
      case json::parse_event_t::object_start:
      case json::parse_event_t::array_start:
        if (names_.size() == kMostLevels) throw Refused{"more than 32 levels of objects and lists"};
        names_.emplace_back();
        break;
      case json::parse_event_t::object_end:
      case json::parse_event_t::array_end:
        names_.pop_back();
        break;
      case json::parse_event_t::key: {
        const auto& name = parsed.get_ref<const std::string&>();
        if (names_.back().insert(name).second) break;
        throw Refused{"the name '" + name + "' comes twice in one object"};
      }
      default:
        break;
    }
    return true;
  }

 private:
  std::vector<std::set<std::string>> names_;  // of each object or list that is open
};

result::Diagnostic unreadable(result::Location where, std::string message) {
  return {.code = "F0901",
          .severity = result::Severity::Error,
          .where = std::move(where),
          .message = std::move(message),
          .hint = {}};
}

}  // namespace

Document read_document(Topic topic, std::string_view text, const std::string& source) {
  Document document;
  if (text.size() > kMostBytes) {
    document.wrong.push_back(unreadable({source, 0, 0}, "the message has more than 4 MiB"));
    return document;
  }
  try {
    document.root = json::parse(text.begin(), text.end(), Watch());
  } catch (const Refused& refused) {
    document.wrong.push_back(unreadable({source, 0, 0}, refused.message));
  } catch (const json::parse_error& error) {
    document.wrong.push_back(unreadable(place_of(text, error.byte, source), "this is no JSON"));
  } catch (const json::exception&) {
    document.wrong.push_back(unreadable({source, 0, 0}, "a number is too large for any computer"));
  }
  if (!document.wrong.empty()) return document;
  Findings findings(source);
  apply(rule_of(topic), document.root, {}, findings);
  if (findings.none()) apply_meaning(topic, document.root, findings);
  document.wrong = findings.take();
  return document;
}

}  // namespace stepwright::fleet::vda5050
