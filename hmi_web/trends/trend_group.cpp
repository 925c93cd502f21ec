#include "hmi_web/trends/trend_group.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <string_view>

#include "hmi_web/trends/codes.h"

namespace stepwright::trends {
namespace {

constexpr std::string_view kBetween = "..";
constexpr double kShortest_s = 0.1;
constexpr double kLongest_s = 400.0 * 86'400;

bool number(std::string_view text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

bool is_name(const std::string& name) {
  const auto printed = [](unsigned char c) { return c >= 0x20 && c != 0x7F; };
  return !name.empty() && name.size() <= kLongestName && std::ranges::all_of(name, printed);
}

bool has_blank_end(const std::string& name) {
  return name.front() == ' ' || name.back() == ' ';
}

auto wrong(const std::string& what, const std::string& hint) {
  return result::fail(kNoGroup, {}, what, hint);
}

}  // namespace

bool is_axis(const std::string& text) {
  if (text.empty() || text == "own") return true;
  const std::string_view all(text);
  const std::size_t at = all.find(kBetween);
  if (text.size() > kLongestAxis || at == std::string_view::npos) return false;
  double least = 0;
  double greatest = 0;
  return number(all.substr(0, at), least) && number(all.substr(at + kBetween.size()), greatest) &&
         least < greatest;
}

result::Result<void> check_name(const std::string& name) {
  if (!is_name(name))
    return wrong("this cannot name a group of trends",
                 "1 to " + std::to_string(kLongestName) + " bytes without control characters");
  if (name == "." || name == "..")
    return wrong("'" + name + "' cannot name a group of trends: in an address it means a folder",
                 "a word that says what is shown");
  if (has_blank_end(name))
    return wrong("the name of a group of trends neither begins nor ends with a blank",
                 "a word that says what is shown");
  return {};
}

result::Result<void> check_group(const TrendGroup& group) {
  if (!is_name(group.name))
    return wrong("this cannot name a group of trends",
                 "1 to " + std::to_string(kLongestName) + " bytes without control characters");
  if (group.series.empty() || group.series.size() > kMostSeries)
    return wrong("a group has 1 to " + std::to_string(kMostSeries) + " tags", "make two groups of it");
  if (!(group.span_s >= kShortest_s && group.span_s <= kLongest_s))
    return wrong("this span cannot be shown", "0.1 s to 400 days");
  std::set<std::string_view> seen;
  for (const TrendSeries& each : group.series) {
    if (each.tag.empty() || each.tag.size() > kLongestTag)
      return wrong("a tag has no name, or too long a one", "as the history calls it");
    if (!seen.insert(each.tag).second)
      return wrong("the tag '" + each.tag + "' is there twice", "leave one of them out");
    if (!is_axis(each.axis))
      return wrong("'" + each.axis + "' is no axis of '" + each.tag + "'",
                   "own, or its ends as 0..100, the least first");
  }
  return {};
}

}  // namespace stepwright::trends
