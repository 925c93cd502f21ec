#include "hmi_web/recipes/recipe_text.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "hmi_web/recipes/codes.h"
#include "hmi_web/recipes/recipe_check.h"

namespace stepwright::recipes {
namespace {

using nlohmann::json;
using std::chrono::system_clock;

constexpr int kFormat = 1;
constexpr std::int64_t kLatestSecond = 9'000'000'000;  // in the year 2255; a time_point ends in 2262
constexpr std::array kMembers = {"comment", "format", "name", "saved_by", "saved_s", "values"};

// The place of a byte, counted from 1.
result::Location place_of(const std::string& file, std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte > 0 ? byte - 1 : 0, text.size()));
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t newline = before.rfind('\n');
  const std::size_t column = before.size() - (newline == std::string_view::npos ? 0 : newline + 1) + 1;
  return {file, static_cast<std::uint32_t>(line), static_cast<std::uint32_t>(column)};
}

// Parses with the place of the first fault; refuses a member that is there twice, of which a parser would
// quietly keep the last.
class Parsing {
 public:
  Parsing(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  result::Result<json> parse() {
    std::vector<std::set<std::string>> keys;
    std::string twice;
    const auto watch = [&](int, json::parse_event_t event, json& parsed) {
      if (event == json::parse_event_t::object_start) keys.emplace_back();
      if (event == json::parse_event_t::object_end && !keys.empty()) keys.pop_back();
      if (event == json::parse_event_t::key && !keys.empty() &&
          !keys.back().insert(parsed.get<std::string>()).second)
        twice = parsed.get<std::string>();
      return true;
    };
    try {
      json document = json::parse(text_, watch);
      if (!twice.empty()) return damaged("'" + twice + "' is there twice", where_of(twice));
      return document;
    } catch (const json::parse_error& error) {
      return damaged("it is no JSON from here on", place_of(file_, text_, error.byte));
    } catch (const json::exception&) {  // a number that no double holds
      return damaged("a number is out of range", {file_, 1, 1});
    }
  }

  // Where a key stands; the first place of that text.
  result::Location where_of(const std::string& key) const {
    const std::size_t at = text_.find("\"" + key + "\"");
    return at == std::string_view::npos ? result::Location{file_, 1, 1} : place_of(file_, text_, at + 1);
  }

  tl::unexpected<result::Diagnostics> damaged(const std::string& what, result::Location where) const {
    return result::fail(kRecipeDamaged, std::move(where), "the file of the recipe is damaged: " + what,
                        "save the recipe anew, or restore its file from a copy");
  }

 private:
  std::string_view text_;
  std::string file_;
};

std::optional<std::string> text_in(const json& object, const char* key, std::size_t longest) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_string()) return std::nullopt;
  auto text = found->get<std::string>();
  if (text.size() > longest) return std::nullopt;
  return text;
}

std::optional<Values> values_in(const json& object) {
  const auto found = object.find("values");
  if (found == object.end() || !found->is_object() || found->size() > kMostTags) return std::nullopt;
  Values values;
  for (const auto& [name, value] : found->items()) {
    if (name.empty() || name.size() > kLongestTag || !value.is_string()) return std::nullopt;
    auto literal = value.get<std::string>();
    if (literal.size() > kLongestLiteral) return std::nullopt;
    values.emplace(name, std::move(literal));
  }
  return values;
}

}  // namespace

std::string to_json(const Recipe& recipe) {
  const auto seconds =
      std::chrono::duration_cast<std::chrono::seconds>(recipe.saved.time_since_epoch()).count();
  const json document = {{"format", kFormat},           {"name", recipe.name}, {"comment", recipe.comment},
                         {"saved_by", recipe.saved_by}, {"saved_s", seconds},  {"values", recipe.values}};
  return document.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

result::Result<Recipe> recipe_from_json(std::string_view text, const std::string& file) {
  Parsing parsing(text, file);
  auto document = parsing.parse();
  if (!document) return result::forward(document);
  if (!document->is_object()) return parsing.damaged("it is no object", {file, 1, 1});
  for (const auto& [key, value] : document->items()) {
    if (std::find(kMembers.begin(), kMembers.end(), key) == kMembers.end())
      return parsing.damaged("there is no member '" + key.substr(0, kLongestName) + "'",
                             parsing.where_of(key));
  }
  const auto wrong = [&](const char* key) {
    return parsing.damaged(std::string("'") + key + "' is missing or cannot be that", parsing.where_of(key));
  };
  if (document->value("format", json()) != kFormat) return wrong("format");
  auto name = text_in(*document, "name", kLongestName);
  if (!name || !check_name(*name)) return wrong("name");
  auto comment = text_in(*document, "comment", kLongestComment);
  if (!comment) return wrong("comment");
  auto saved_by = text_in(*document, "saved_by", kLongestName);
  if (!saved_by) return wrong("saved_by");
  const json saved = document->value("saved_s", json());
  if (!saved.is_number_integer() || saved < 0 || saved > kLatestSecond) return wrong("saved_s");
  auto values = values_in(*document);
  if (!values) return wrong("values");
  const system_clock::time_point when{std::chrono::seconds(saved.get<std::int64_t>())};
  return Recipe{std::move(*name), std::move(*comment), std::move(*saved_by), when, std::move(*values)};
}

}  // namespace stepwright::recipes
