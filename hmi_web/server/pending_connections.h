#pragma once

// Registry of the connections whose request has not arrived yet. When there is no room for another
// connection, it closes the one that has waited longest, of the address that has most of them: whoever opens
// sockets and sends nothing loses them first.
//
//   const auto ticket = pending.add("192.0.2.7", [] { close the connection; });
//   pending.remove(ticket);           // its request is here
//   if (!pending.close_one()) ...     // none is pending: there is no room
//
// Threads: one (the network's).

#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace stepwright::server {

class PendingConnections {
 public:
  using Ticket = std::uint64_t;  // 0: none

  Ticket add(std::string address, std::function<void()> close);
  void remove(Ticket ticket) { waiting_.erase(ticket); }
  bool close_one();

 private:
  struct Entry {
    std::string address;
    std::function<void()> close;
  };
  Ticket last_ = 0;
  std::map<Ticket, Entry> waiting_;  // the oldest first
};

}  // namespace stepwright::server
