#include "hmi_web/server/pending_connections.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

namespace stepwright::server {

PendingConnections::Ticket PendingConnections::add(std::string address, std::function<void()> close) {
  waiting_.emplace(++last_, Entry{std::move(address), std::move(close)});
  return last_;
}

bool PendingConnections::close_one() {
  std::map<std::string_view, std::size_t> of_address;
  for (const auto& [ticket, entry] : waiting_) ++of_address[entry.address];
  const auto most = std::ranges::max_element(of_address, {}, [](const auto& each) { return each.second; });
  if (most == of_address.end()) return false;
  const auto oldest =
      std::ranges::find_if(waiting_, [&](const auto& each) { return each.second.address == most->first; });
  const std::function<void()> close = std::move(oldest->second.close);
  waiting_.erase(oldest);
  close();
  return true;
}

}  // namespace stepwright::server
