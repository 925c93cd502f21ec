#include "hmi_web/notify/told_store.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "hmi_web/access/durable_file.h"

namespace stepwright::notify {
namespace {

using nlohmann::json;

constexpr std::size_t kLargestFile = std::size_t{4} << 20;

std::map<std::string, ToldAlarms> read_told(const std::filesystem::path& file) {
  const auto text = access::read_bounded(file, kLargestFile);
  if (!text || text->size() > kLargestFile) return {};
  try {
    return json::parse(*text).get<std::map<std::string, ToldAlarms>>();
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
  return access::replace_private_file(
      file_, json(channels_).dump(1, ' ', false, json::error_handler_t::replace) + "\n");
}

}  // namespace stepwright::notify
