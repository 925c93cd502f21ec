#pragma once

// The inner thread of RuntimeData: the connection to the runtime, and what the server's loop and it share.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "runtime/host/notifier.h"
#include "runtime/modbus/map/register_map.h"
#include "runtime/modbus/server/runtime_data.h"
#include "runtime/service/connection.h"

namespace stepwright::modbus::server::internal {

using Clock = std::chrono::steady_clock;

// A program as it is served. Immutable; the connection keeps the snapshot's memory mapped.
struct Program {
  std::shared_ptr<service::Connection> connection;
  map::RegisterMap map;
  std::string digest;
};

struct QueuedWrite {
  std::uint64_t ticket = 0;
  host::BlockWrite block;
  Clock::time_point deadline;  // then it is answered with exception 4, sent or not
};

// Writes that wait to be sent. A client has one at most, and there are 10 000 clients at most: whatever is
// more was left by clients that have gone.
inline constexpr std::size_t kMostQueued = 16'384;

// Between the two threads.
struct Exchange {
  std::mutex mutex;
  std::shared_ptr<const Program> program;      // under the mutex; null: nothing can be read
  std::deque<QueuedWrite> writes;              // under the mutex: not sent yet
  std::deque<Written> written;                 // under the mutex
  std::atomic<std::uint64_t> changes{0};       // of `program`
  std::atomic<std::int64_t> good_until_ns{0};  // Clock: values are of no use after
  std::atomic<bool> quit{false};
  host::Notifier work;  // for the session: writes, quit
  host::Notifier done;  // for the server's loop: written

  bool ok() const { return work.ok() && done.ok(); }
};

class RuntimeSession {
 public:
  // Both must outlive it.
  RuntimeSession(const RuntimeDataOptions& options, const News& news, Exchange& exchange);

  // Until `quit`. The body of the thread.
  void run();

 private:
  struct UnderWay {
    std::uint64_t ticket = 0;
    Clock::time_point deadline;
  };
  bool attach();
  void attend();
  void hear(const service::Message& message);
  void hear_status(const host::RuntimeStatus& status);
  void load(const std::string& digest);
  [[nodiscard]] result::Result<std::vector<std::byte>> read_program(const std::string& digest);
  void publish(std::shared_ptr<const Program> program);
  void send_writes();
  void expire(Clock::time_point now);
  void answer(std::uint64_t ticket, pdu::Exception exception);
  void detach();
  void fail_queued();

  const RuntimeDataOptions& options_;
  const News& news_;
  Exchange& exchange_;
  std::shared_ptr<service::Connection> connection_;
  std::string digest_;   // of the program that is served
  std::string refused_;  // of one that cannot be: it is not fetched again with every status
  std::uint64_t client_;
  std::uint64_t last_id_ = 0;
  std::map<std::uint64_t, UnderWay> under_way_;  // by request
  std::uint64_t sequence_ = 0;                   // of the snapshot, and since when
  Clock::time_point changed_;
  bool told_absent_ = false;
};

}  // namespace stepwright::modbus::server::internal
