#include "hmi_web/notify/notification_store.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "hmi_web/storage/private_files.h"
#include "runtime/ground/files/durable_file.h"

namespace stepwright::notify {
namespace {

using nlohmann::json;

constexpr std::size_t kLargestFile = std::size_t{4} << 20;

Notification notification_of(const json& entry) {
  // A number alone: of a version that did not know when.
  if (entry.is_number_integer()) return {entry.get<std::int64_t>(), 0};
  return {entry.at("raised_ns").get<std::int64_t>(), entry.at("told_ms").get<std::int64_t>()};
}

json to_json(const Notifications& alarms) {
  json entries = json::object();
  for (const auto& [name, told] : alarms)
    entries[name] = {{"raised_ns", told.raised_ns}, {"told_ms", told.told_ms}};
  return entries;
}

std::map<std::string, Notifications> read_notifications(const std::filesystem::path& file) {
  const auto text = files::read_bounded(file, kLargestFile);
  if (!text || text->size() > kLargestFile) return {};
  try {
    std::map<std::string, Notifications> channels;
    const json whole = json::parse(*text);
    for (const auto& [channel, alarms] : whole.items())
      for (const auto& [name, entry] : alarms.items()) channels[channel][name] = notification_of(entry);
    return channels;
  } catch (const json::exception&) {
    return {};
  }
}

}  // namespace

NotificationStore::NotificationStore(std::filesystem::path file)
    : file_(std::move(file)), channels_(read_notifications(file_)) {}

Notifications NotificationStore::of(const std::string& channel) const {
  const std::lock_guard lock(mutex_);
  const auto found = channels_.find(channel);
  return found == channels_.end() ? Notifications() : found->second;
}

result::Result<void> NotificationStore::keep(const std::string& channel, Notifications alarms) {
  const std::lock_guard lock(mutex_);
  channels_[channel] = std::move(alarms);
  json whole = json::object();
  for (const auto& [name, told] : channels_) whole[name] = to_json(told);
  return files::replace_file(file_, whole.dump(1, ' ', false, json::error_handler_t::replace) + "\n",
                             storage::kPrivateFile);
}

}  // namespace stepwright::notify
