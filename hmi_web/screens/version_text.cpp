#include "hmi_web/screens/version_text.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "hmi_web/screens/codes.h"

namespace stepwright::screens {
namespace {

using nlohmann::json;
using std::chrono::system_clock;

constexpr int kFormat = 1;
constexpr std::int64_t kLatestSecond = 9'000'000'000;  // in the year 2255; a time_point ends in 2262
constexpr std::int64_t kGreatestNumber = 999'999;

bool is_count(const json& value, std::int64_t most) {
  return value.is_number_integer() && value >= 0 && value <= most;
}

bool is_text(const json& value, std::size_t longest) {
  return value.is_string() && value.get_ref<const std::string&>().size() <= longest;
}

}  // namespace

std::string to_json(const Version& version) {
  const auto seconds =
      std::chrono::duration_cast<std::chrono::seconds>(version.saved.time_since_epoch()).count();
  const json document = {{"format", kFormat},
                         {"version", version.number},
                         {"based_on", version.based_on},
                         {"saved_by", version.saved_by},
                         {"saved_s", seconds},
                         {"comment", version.comment},
                         {"least", version.least},
                         {"symbol", version.is_symbol},
                         {"aside", version.aside},
                         {"removed", version.removed}};
  return document.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

result::Result<Version> version_from_json(std::string_view text, const std::string& file) {
  const auto damaged = [&](const std::string& what) {
    return result::fail(kScreenDamaged, {file, 1, 1}, "the file of the version is damaged: " + what,
                        "restore it and the SVG beside it from a copy, or remove both");
  };
  const json found = json::parse(text, nullptr, false);
  if (!found.is_object()) return damaged("it is no JSON object");
  const auto member = [&](const char* key) { return found.value(key, json()); };
  if (member("format") != kFormat) return damaged("'format' is not " + std::to_string(kFormat));
  for (const char* key : {"version", "based_on"})
    if (!is_count(member(key), kGreatestNumber)) return damaged(std::string("'") + key + "' is no number");
  if (!is_count(member("saved_s"), kLatestSecond)) return damaged("'saved_s' is no time");
  if (!is_text(member("saved_by"), kLongestName) || !is_text(member("comment"), kLongestComment))
    return damaged("'saved_by' or 'comment' is no text, or too long");
  const json least = member("least");
  if (least != "viewer" && least != "operator" && least != "engineer") return damaged("'least' is no role");
  for (const char* key : {"symbol", "aside", "removed"})
    if (!member(key).is_boolean()) return damaged(std::string("'") + key + "' is neither true nor false");
  return Version{
      .number = member("version").get<std::uint32_t>(),
      .based_on = member("based_on").get<std::uint32_t>(),
      .saved_by = member("saved_by").get<std::string>(),
      .saved = system_clock::time_point{std::chrono::seconds(member("saved_s").get<std::int64_t>())},
      .comment = member("comment").get<std::string>(),
      .least = least.get<std::string>(),
      .is_symbol = member("symbol").get<bool>(),
      .aside = member("aside").get<bool>(),
      .removed = member("removed").get<bool>()};
}

}  // namespace stepwright::screens
