#pragma once

// The requests of one client that wait for their answer.
//
// Threads: every function from any thread.

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>

#include "runtime/service/requests.h"

namespace stepwright::dds::internal {

class RequestTable {
 public:
  // `client` names this client towards every runtime; no two may share it.
  RequestTable(std::uint64_t client, bool supervisor) : client_(client), supervisor_(supervisor) {}

  // A request under a new id, expected to be answered until `forget`.
  service::Request open(service::RequestBody body);
  // The answer to an open request of this client; anything else is ignored.
  void answer(service::Reply reply);
  // Waits up to `timeout` for the answer to `id`.
  std::optional<service::Reply> wait(std::uint64_t id, std::chrono::milliseconds timeout);
  void forget(std::uint64_t id);

 private:
  const std::uint64_t client_;
  const bool supervisor_;
  std::mutex mutex_;
  std::condition_variable answered_;
  std::uint64_t last_id_ = 0;
  std::map<std::uint64_t, std::optional<service::Reply>> open_;
};

}  // namespace stepwright::dds::internal
