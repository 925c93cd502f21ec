#include "runtime/service/internal/reply_cache.h"

#include <algorithm>

namespace stepwright::service::internal {

void ReplyCache::add(const Reply& reply) {
  auto client = std::find_if(clients_.begin(), clients_.end(),
                             [&](const Client& c) { return c.number == reply.client; });
  if (client == clients_.end()) {
    clients_.push_front({reply.client, {}});
    if (clients_.size() > kClients) clients_.pop_back();
  } else {
    clients_.splice(clients_.begin(), clients_, client);
  }
  std::deque<Reply>& replies = clients_.front().replies;
  replies.push_back(reply);
  if (replies.size() > kReplies) replies.pop_front();
}

const Reply* ReplyCache::find(std::uint64_t client, std::uint64_t id) const {
  for (const Client& known : clients_) {
    if (known.number != client) continue;
    const auto found = std::find_if(known.replies.begin(), known.replies.end(),
                                    [&](const Reply& reply) { return reply.id == id; });
    return found == known.replies.end() ? nullptr : &*found;
  }
  return nullptr;
}

}  // namespace stepwright::service::internal
