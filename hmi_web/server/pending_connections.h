#pragma once

// The connections of which a request is still awaited, so that none of them keeps others out: when there is
// no room for another connection, one of them makes it. That is the one that waits for longest of the address
// that has most of them: whoever fills the server with sockets that say nothing loses them first.
//
//   const auto ticket = room.enter("192.0.2.7", [] { close the connection; });
//   room.leave(ticket);               // its request is here
//   if (!room.turn_one_out()) ...     // nobody waits: there really is no room
//
// Threads: one (the network's).

#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace stepwright::server {

class WaitingRoom {
 public:
  using Ticket = std::uint64_t;  // 0: of nobody

  Ticket enter(std::string address, std::function<void()> turn_out);
  void leave(Ticket ticket) { waiting_.erase(ticket); }
  bool turn_one_out();

 private:
  struct Entry {
    std::string address;
    std::function<void()> turn_out;
  };
  Ticket last_ = 0;
  std::map<Ticket, Entry> waiting_;  // the oldest first
};

}  // namespace stepwright::server
