#include "hmi_web/trends/trend_store.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "hmi_web/storage/private_files.h"
#include "hmi_web/trends/codes.h"
#include "runtime/ground/files/durable_file.h"

namespace stepwright::trends {
namespace {

using nlohmann::json;
using std::chrono::system_clock;

constexpr std::size_t kLargestFile = 4 << 20;
constexpr std::int64_t kLatestSecond = 9'000'000'000;  // in the year 2255; a time_point ends in 2262

json to_json(const TrendGroup& group) {
  json series = json::array();
  for (const TrendSeries& each : group.series) series.push_back({{"tag", each.tag}, {"axis", each.axis}});
  const auto saved = std::chrono::duration_cast<std::chrono::seconds>(group.saved.time_since_epoch());
  return {{"name", group.name},
          {"series", std::move(series)},
          {"span_s", group.span_s},
          {"saved_by", group.saved_by},
          {"saved_s", saved.count()}};
}

// "group ..", "group" of blanks.
std::string usable(const std::string& name) {
  const auto first = name.find_first_not_of(' ');
  if (first == std::string::npos) return "group";
  const std::string word = name.substr(first, name.find_last_not_of(' ') - first + 1);
  return check_name(word) ? word : "group " + word;
}

std::optional<TrendGroup> group_of(const json& object) {
  if (!object.is_object()) return std::nullopt;
  TrendGroup group;
  try {
    group.name = object.at("name").get<std::string>();
    group.span_s = object.at("span_s").get<double>();
    group.saved_by = object.at("saved_by").get<std::string>();
    const auto saved_s = object.at("saved_s").get<std::int64_t>();
    if (saved_s < 0 || saved_s > kLatestSecond) return std::nullopt;
    group.saved = system_clock::time_point(std::chrono::seconds(saved_s));
    for (const json& each : object.at("series"))
      group.series.push_back({each.at("tag").get<std::string>(), each.at("axis").get<std::string>()});
  } catch (const json::exception&) {
    return std::nullopt;
  }
  if (!check_group(group)) return std::nullopt;
  // Of a server before this one, which took them: no address leads to such a name.
  if (!check_name(group.name)) group.name = usable(group.name);
  return group;
}

bool by_name(const TrendGroup& a, const TrendGroup& b) {
  return a.name < b.name;
}

std::optional<std::vector<TrendGroup>> groups_of(const std::string& text) {
  const json document = json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!document.is_object() || !document.contains("groups") || !document["groups"].is_array())
    return std::nullopt;
  std::vector<TrendGroup> groups;
  for (const json& each : document["groups"]) {
    auto group = group_of(each);
    if (!group || groups.size() == kMostGroups) return std::nullopt;
    groups.push_back(*std::move(group));
  }
  std::ranges::sort(groups, by_name);
  return groups;
}

// A damaged file that was put aside earlier stays.
std::filesystem::path free_name_beside(const std::filesystem::path& file) {
  std::error_code ignored;  // then the renaming says what is wrong
  std::filesystem::path aside = file.string() + ".damaged";
  for (int number = 2; std::filesystem::exists(aside, ignored); ++number)
    aside = file.string() + ".damaged-" + std::to_string(number);
  return aside;
}

}  // namespace

result::Result<std::unique_ptr<TrendStore>> TrendStore::open(std::filesystem::path file) {
  std::unique_ptr<TrendStore> store(new TrendStore(std::move(file)));
  std::error_code error;
  if (!std::filesystem::exists(store->file_, error)) return store;
  const auto text = files::read_bounded(store->file_, kLargestFile);
  auto groups = text && text->size() <= kLargestFile ? groups_of(*text) : std::nullopt;
  if (groups) {
    store->groups_ = *std::move(groups);
    return store;
  }
  const std::filesystem::path aside = free_name_beside(store->file_);
  if (std::filesystem::is_regular_file(store->file_, error)) {
    std::filesystem::rename(store->file_, aside, error);
  } else if (!error) {
    error = std::make_error_code(std::errc::not_supported);
  }
  if (error)
    return result::fail(storage::kFileFails, {store->file_.string(), 0, 0},
                        "the saved trends cannot be read, nor put aside: " + error.message());
  store->found_ = "the saved trends could not be read; their file is " + aside.string() + " now";
  return store;
}

std::vector<TrendGroup> TrendStore::list() const {
  const std::lock_guard lock(mutex_);
  return groups_;
}

result::Result<void> TrendStore::write(const std::vector<TrendGroup>& groups) const {
  json list = json::array();
  for (const TrendGroup& each : groups) list.push_back(to_json(each));
  return files::replace_file(
      file_, json{{"groups", std::move(list)}}.dump(1, ' ', false, json::error_handler_t::replace),
      storage::kPrivateFile);
}

result::Result<std::optional<TrendGroup>> TrendStore::save(const TrendGroup& group) {
  if (auto right = check_name(group.name); !right) return result::forward(right);
  if (auto right = check_group(group); !right) return result::forward(right);
  const std::lock_guard lock(mutex_);
  std::vector<TrendGroup> groups = groups_;
  std::optional<TrendGroup> before;
  const auto same = std::ranges::find(groups, group.name, &TrendGroup::name);
  if (same != groups.end()) {
    before = std::exchange(*same, group);
  } else if (groups.size() == kMostGroups) {
    return result::fail(kNoRoomForGroup, {}, "there are " + std::to_string(kMostGroups) + " groups already",
                        "remove one of them");
  } else {
    groups.push_back(group);
    std::ranges::sort(groups, by_name);
  }
  if (auto written = write(groups); !written) return result::forward(written);
  groups_ = std::move(groups);
  return before;
}

result::Result<TrendGroup> TrendStore::remove(const std::string& name) {
  const std::lock_guard lock(mutex_);
  std::vector<TrendGroup> groups = groups_;
  const auto same = std::ranges::find(groups, name, &TrendGroup::name);
  if (same == groups.end())
    return result::fail(kNoSuchGroup, {}, "there is no group of trends '" + name + "'",
                        "somebody may have removed it meanwhile");
  TrendGroup before = std::move(*same);
  groups.erase(same);
  if (auto written = write(groups); !written) return result::forward(written);
  groups_ = std::move(groups);
  return before;
}

}  // namespace stepwright::trends
