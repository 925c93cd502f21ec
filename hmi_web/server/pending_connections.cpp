#include "hmi_web/server/pending_connections.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

namespace stepwright::server {

WaitingRoom::Ticket WaitingRoom::enter(std::string address, std::function<void()> turn_out) {
  waiting_.emplace(++last_, Entry{std::move(address), std::move(turn_out)});
  return last_;
}

bool WaitingRoom::turn_one_out() {
  std::map<std::string_view, std::size_t> of_address;
  for (const auto& [ticket, entry] : waiting_) ++of_address[entry.address];
  const auto most = std::ranges::max_element(of_address, {}, [](const auto& each) { return each.second; });
  if (most == of_address.end()) return false;
  const auto oldest =
      std::ranges::find_if(waiting_, [&](const auto& each) { return each.second.address == most->first; });
  const std::function<void()> turn_out = std::move(oldest->second.turn_out);
  waiting_.erase(oldest);
  turn_out();
  return true;
}

}  // namespace stepwright::server
