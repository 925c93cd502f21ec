#pragma once

// State of a RuntimeClient: the endpoints of one client, its open requests, and the newest news of its
// runtime.
//
// Threads: Fast DDS calls the handlers from its own threads; everything shared is behind `mutex` or a
// RequestTable.

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "runtime/dds/internal/event_order.h"
#include "runtime/dds/internal/message_endpoints.h"
#include "runtime/dds/internal/namesakes.h"
#include "runtime/dds/internal/request_table.h"
#include "runtime/dds/runtime_client.h"

namespace stepwright::dds::internal {

class ClientSession {
 public:
  // `place` as in the configuration; `process` as it calls itself.
  ClientSession(std::unique_ptr<Participant> participant, ClientRole role, std::uint64_t client,
                std::string place, const std::string& process);

  bool ok() const;
  bool runtime_alive() const;
  bool wait_for_runtime(std::chrono::milliseconds timeout);
  // Sends and resends until answered; a refusal is an error.
  [[nodiscard]] result::Result<service::Reply> ask(service::RequestBody body);
  std::optional<StepEvent> wait_event(std::chrono::milliseconds timeout);
  std::optional<RuntimeStatus> status() const;
  std::optional<Snapshot> snapshot() const;
  bool wait_snapshot(std::chrono::milliseconds timeout);
  std::optional<RuntimeHealth> health() const;
  std::vector<TopicTraffic> traffic() const;
  TopicTraffic snapshot_traffic() const { return snapshot_reader_.traffic(); }

 private:
  using Clock = std::chrono::steady_clock;

  void on_status(service::LinkStatus news);
  void on_other_version(std::uint32_t version);
  void on_event(StepEvent event);
  void on_snapshot(Snapshot snapshot);
  void on_health(RuntimeHealth health);
  // These two with the lock held.
  bool reachable() const;
  bool link_is_of_another_version() const { return other_version_ && status_reader_.alive(); }
  [[nodiscard]] result::Result<service::Reply> ask_once(const service::RequestBody& body);
  tl::unexpected<result::Diagnostics> nobody_answers() const;
  tl::unexpected<result::Diagnostics> other_version() const;
  // Says until it is stopped that this supervisor lives.
  void beat(const std::stop_token& stop, const std::string& process, std::uint64_t client);
  // Asks for missing events, at most every `kResendPeriod`, and learns what the runtime has forgotten.
  void fetch_missing(std::unique_lock<std::mutex>& lock);

  std::unique_ptr<Participant> participant_;
  const std::string place_;
  RequestTable requests_;
  Namesakes namesakes_;

  mutable std::mutex mutex_;
  std::condition_variable news_;
  bool runtime_connected_ = false;
  std::optional<std::uint32_t> other_version_;  // of the newest status, if it could not be read
  std::optional<RuntimeStatus> status_;
  std::optional<Snapshot> snapshot_;
  bool snapshot_is_new_ = false;  // nobody has waited for it
  std::condition_variable snapshot_news_;
  std::optional<RuntimeHealth> health_;
  EventOrder events_;
  std::uint64_t fetch_id_ = 0;  // the open ResendEvents request, 0 = none
  Clock::time_point fetch_at_{};

  MessageWriter<service::Request> request_writer_;
  std::unique_ptr<MessageWriter<service::Presence>> presence_;  // a supervisor only
  std::jthread heart_;                                          // writes it
  // Last, so that they are silent before what their handlers use is gone.
  MessageReader<service::Reply> reply_reader_;
  MessageReader<StepEvent> event_reader_;
  MessageReader<Snapshot> snapshot_reader_;
  MessageReader<RuntimeHealth> health_reader_;
  MessageReader<service::LinkStatus> status_reader_;
};

}  // namespace stepwright::dds::internal
