#pragma once

// A client's connection to the service of a runtime, for the link process, tools and tests.
//
//   auto connection = Connection::open(socket_path, {.role = Role::Controller, .name = "link"});
//   auto reply = (*connection)->call(Start{.barrier = true}, 1s);
//   while (auto message = (*connection)->receive(100ms)) ...          // replies, events, status
//   auto snapshot = (*connection)->snapshot();
//
// Threads: one. A connection that has failed stays closed; open another.

#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "runtime/ground/result/result.h"
#include "runtime/host/snapshot_memory.h"
#include "runtime/service/messages.h"

namespace stepwright::service {

struct ConnectionOptions {
  Role role = Role::Observer;
  std::string name;               // of the process, up to kMaxNameBytes
  std::uint64_t first_event = 0;  // 0: only events to come
};

class Connection {
 public:
  // Connects and greets. Fails with R0001: nobody serves the path, or it does not answer within a second.
  [[nodiscard]] static result::Result<std::unique_ptr<Connection>> open(const std::filesystem::path& socket,
                                                                        const ConnectionOptions& options);
  ~Connection();

  // For poll(): readable when receive() has something, or when the connection ended.
  int descriptor() const;
  bool closed() const;

  // Sends a message under the sender's own numbers. False: closed.
  bool send(const Message& message);
  // The same for one that somebody else has made: its bytes (codec.h), found to be a message. What is none
  // ends the connection at the other end.
  bool pass_on(std::span<const std::byte> message);
  // The next message; none after `timeout` or when the connection ended.
  std::optional<Message> receive(std::chrono::milliseconds timeout);
  // The newest image, read from shared memory.
  std::optional<host::Snapshot> snapshot() const;
  // The same memory, to read parts of it; any thread, as long as the connection lives.
  const host::SnapshotReader& snapshots() const;

  // Sends a request of this connection and waits for its answer; what else arrives is kept for receive(). A
  // refusal is an error with its diagnostics.
  [[nodiscard]] result::Result<Reply> call(RequestBody body, std::chrono::milliseconds timeout);
  // Begin, chunks and commit. Returns the digest.
  [[nodiscard]] result::Result<std::string> download(std::span<const std::byte> container,
                                                     std::chrono::milliseconds timeout);
  // The same with the whole answer: what an online change carried, and notes on it.
  [[nodiscard]] result::Result<Reply> download(std::span<const std::byte> container, host::DownloadMode mode,
                                               std::chrono::milliseconds timeout);

 private:
  struct State;
  explicit Connection(std::unique_ptr<State> state);
  std::optional<Message> receive_new(std::chrono::milliseconds timeout);
  std::unique_ptr<State> state_;
};

}  // namespace stepwright::service
