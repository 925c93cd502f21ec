#include "cell/hmi/notify_channels.h"

#include <utility>

namespace stepwright::hmi {
namespace {

alarms::Priority priority_of(const std::string& word) {
  for (std::uint8_t i = 0; i < alarms::kPriorities; ++i) {
    const auto priority = static_cast<alarms::Priority>(i);
    if (word == alarms::to_string(priority)) return priority;
  }
  return alarms::Priority::High;
}

}  // namespace

std::vector<notify::Channel> notify_channels(std::span<const config::NotifyConfig> configured) {
  std::vector<notify::Channel> channels;
  for (const config::NotifyConfig& each : configured) {
    notify::Channel channel;
    channel.name = each.name;
    channel.server = each.server;
    channel.from = each.from;
    channel.to = each.mail;
    channel.user = each.user;
    channel.password = each.password;
    channel.needs_tls = each.tls;
    channel.web_hook = each.web_hook;
    channel.at_least = priority_of(each.priority);
    channel.delay = each.delay;
    channel.repeat = each.repeat;
    channels.push_back(std::move(channel));
  }
  return channels;
}

}  // namespace stepwright::hmi
