#pragma once

// The newest replies by (client, request), so that a repeated request is answered and not performed again.
//
// Threads: one. Bounded: the newest replies of the newest clients.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <list>

#include "runtime/service/requests.h"

namespace stepwright::service::internal {

class ReplyCache {
 public:
  static constexpr std::size_t kClients = 32;
  static constexpr std::size_t kReplies = 128;  // of one client; it never has so many requests open

  void add(const Reply& reply);
  // Null if there is none.
  const Reply* find(std::uint64_t client, std::uint64_t id) const;

 private:
  struct Client {
    std::uint64_t number = 0;
    std::deque<Reply> replies;
  };
  std::list<Client> clients_;  // the one that asked last is first
};

}  // namespace stepwright::service::internal
