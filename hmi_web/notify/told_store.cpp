#include "hmi_web/notify/told_store.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "hmi_web/storage/private_files.h"
#include "runtime/ground/files/durable_file.h"

namespace stepwright::notify {
namespace {

using nlohmann::json;

constexpr std::size_t kLargestFile = std::size_t{4} << 20;

Told told_of(const json& entry) {
  // A number alone: of a version that did not know when.
  if (entry.is_number_integer()) return {entry.get<std::int64_t>(), 0};
  return {entry.at("raised_ns").get<std::int64_t>(), entry.at("told_ms").get<std::int64_t>()};
}

json to_json(const ToldAlarms& alarms) {
  json entries = json::object();
  for (const auto& [name, told] : alarms)
    entries[name] = {{"raised_ns", told.raised_ns}, {"told_ms", told.told_ms}};
  return entries;
}

std::map<std::string, ToldAlarms> read_told(const std::filesystem::path& file) {
  const auto text = files::read_bounded(file, kLargestFile);
  if (!text || text->size() > kLargestFile) return {};
  try {
    std::map<std::string, ToldAlarms> channels;
    const json whole = json::parse(*text);
    for (const auto& [channel, alarms] : whole.items())
      for (const auto& [name, entry] : alarms.items()) channels[channel][name] = told_of(entry);
    return channels;
  } catch (const json::exception&) {
    return {};
  }
}

}  // namespace

ToldStore::ToldStore(std::filesystem::path file) : file_(std::move(file)), channels_(read_told(file_)) {}

ToldAlarms ToldStore::of(const std::string& channel) const {
  const std::lock_guard lock(mutex_);
  const auto found = channels_.find(channel);
  return found == channels_.end() ? ToldAlarms() : found->second;
}

result::Result<void> ToldStore::keep(const std::string& channel, ToldAlarms alarms) {
  const std::lock_guard lock(mutex_);
  channels_[channel] = std::move(alarms);
  json whole = json::object();
  for (const auto& [name, told] : channels_) whole[name] = to_json(told);
  return files::replace_file(file_, whole.dump(1, ' ', false, json::error_handler_t::replace) + "\n",
                             storage::kPrivateFile);
}

}  // namespace stepwright::notify
