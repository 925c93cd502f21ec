#include "supervisor/ltl/scene/internal/json_text.h"

#include <algorithm>
#include <sstream>
#include <unordered_set>
#include <utility>
#include <vector>

namespace stepwright::ltl::internal {

using nlohmann::json;

namespace {

constexpr std::size_t kLongestName = 60;  // of a member, in a message

result::Location place_of(std::string_view text, std::size_t byte, const std::string& file) {
  const std::string_view before = text.substr(0, std::min(byte > 0 ? byte - 1 : 0, text.size()));
  const auto line = static_cast<std::uint32_t>(std::ranges::count(before, '\n')) + 1;
  const std::size_t start = before.rfind('\n');
  const std::size_t column = before.size() - (start == std::string_view::npos ? 0 : start + 1);
  return {file, line, static_cast<std::uint32_t>(column) + 1};
}

// The second of two members of one name in one object: where its name begins. Requires JSON; a name with an
// escape is another one than the same name without it.
std::size_t repeated_member(std::string_view text) {
  std::vector<std::unordered_set<std::string_view>> objects;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '{') objects.emplace_back();
    if (text[at] == '}') objects.pop_back();
    if (text[at] != '"') continue;
    const std::size_t begin = at;
    for (++at; text[at] != '"'; ++at)
      if (text[at] == '\\') ++at;
    const std::size_t behind = text.find_first_not_of(" \t\r\n", at + 1);
    if (behind == std::string_view::npos || text[behind] != ':') continue;
    if (!objects.back().insert(text.substr(begin, at - begin)).second) return begin;
  }
  return std::string_view::npos;
}

std::string range(double least, double most) {
  std::ostringstream text;
  text << "from " << least << " to " << most;
  return text.str();
}

}  // namespace

void Complaints::add(const char* code, const std::string& key, const std::string& message, std::string hint) {
  found.push_back({code,
                   result::Severity::Error,
                   {file_, 0, 0},
                   (key.empty() ? "" : key + ": ") + message,
                   std::move(hint)});
}

void Complaints::take(result::Diagnostics&& more) {
  for (auto& each : more) {
    if (each.where.file.empty()) each.where.file = file_;
    found.push_back(std::move(each));
  }
}

result::Result<json> parse(std::string_view text, const std::string& file) try {
  json read = json::parse(text);
  const std::size_t again = repeated_member(text);
  if (again == std::string_view::npos) return read;
  const std::size_t end = text.find('"', again + 1);
  return result::fail("L0405", place_of(text, again + 1, file),
                      "the member " +
                          std::string(text.substr(again, std::min(end - again + 1, kLongestName))) +
                          " is there twice",
                      "leave one of them out");
} catch (const json::parse_error& error) {
  return result::fail("L0401", place_of(text, error.byte, file), "this is no JSON",
                      "a member or a bracket is missing, or one too many");
} catch (const json::exception& error) {
  // A number beyond all doubles, which the text has between quotes.
  const std::string said = error.what();
  const std::size_t begin = said.find('\''), end = said.rfind('\'');
  const std::string number = begin < end ? said.substr(begin + 1, end - begin - 1) : "";
  const std::size_t at = number.empty() ? std::string_view::npos : text.find(number);
  const result::Location where =
      at == std::string_view::npos ? result::Location{file, 0, 0} : place_of(text, at + 1, file);
  return result::fail("L0403", where, "the number " + number + " is out of range");
}

const json& member(const json& object, const char* name) {
  static const json kNone;
  if (!object.is_object()) return kNone;
  const auto found = object.find(name);
  return found == object.end() ? kNone : *found;
}

std::optional<double> number(const json& value, const std::string& key, double least, double most,
                             Complaints& wrong) {
  if (!value.is_number()) {
    wrong.add("L0402", key, "is no number");
    return std::nullopt;
  }
  const double read = value.get<double>();
  if (read >= least && read <= most) return read;
  wrong.add("L0403", key, "is out of range", range(least, most));
  return std::nullopt;
}

bool is_object(const json& value, const std::string& key, std::initializer_list<const char*> names,
               Complaints& wrong) {
  if (!value.is_object()) {
    wrong.add("L0402", key, "is no object");
    return false;
  }
  for (const auto& each : value.items()) {
    const bool known = std::ranges::any_of(names, [&](const char* name) { return each.key() == name; });
    if (!known) wrong.add("L0402", key.empty() ? each.key() : key + "." + each.key(), "is not known here");
  }
  return true;
}

}  // namespace stepwright::ltl::internal
