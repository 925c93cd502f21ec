#pragma once

// One client of the service: its socket, what it has sent so far, and what is still to be sent to it.
//
// Threads: the service's. Nothing blocks; what a client does not read is bounded.

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/ground/files/descriptor.h"
#include "runtime/service/codec.h"

namespace stepwright::service::internal {

using files::Descriptor;

class Session {
 public:
  using Clock = std::chrono::steady_clock;

  // Of a socket that was accepted just now.
  Session(std::uint64_t number, Descriptor socket);

  std::uint64_t number() const { return number_; }
  // The process at the other end, as the system names it; 0 if it does not.
  pid_t process() const { return process_; }
  Clock::time_point since() const { return since_; }
  int descriptor() const { return socket_.get(); }
  bool closed() const { return closed_; }
  void close() { closed_ = true; }

  // Whether something is there to read.
  bool readable() const;
  // Reads what is there, up to a bound per call. Closes on the end of the stream and on errors.
  void read();
  // The next message of the client. A malformed one closes the session.
  std::optional<Message> next();

  // Queues a message. A client that lets kMaxUnsent pile up is closed, as is one for whose message there is
  // no memory: half of it may be queued.
  void send(const Message& message);
  // The answer to Hello, with the descriptor of the snapshot memory beside it.
  void welcome(int snapshot_descriptor);
  // Sends as much as the socket takes.
  void write();
  bool wants_to_write() const { return !out_.empty(); }
  // True while bulk messages (events, status) may be added.
  bool keeps_up() const { return out_.size() - sent_ < kBulkLimit; }

  // Set by Hello.
  bool greeted = false;
  Role role = Role::Observer;
  std::string name;
  std::uint64_t next_event = 0;

 private:
  static constexpr std::size_t kBulkLimit = 2u << 20;
  static constexpr std::size_t kMaxUnsent = 16u << 20;

  std::uint64_t number_;
  Descriptor socket_;
  pid_t process_ = 0;
  Clock::time_point since_;
  FrameBuffer in_;
  std::vector<std::byte> out_;
  std::size_t sent_ = 0;
  bool closed_ = false;
};

}  // namespace stepwright::service::internal
