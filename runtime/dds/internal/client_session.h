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

#include "runtime/dds/internal/convert.h"
#include "runtime/dds/internal/event_order.h"
#include "runtime/dds/internal/namesakes.h"
#include "runtime/dds/internal/participant.h"
#include "runtime/dds/internal/request_table.h"
#include "runtime/dds/runtime_client.h"
#include "runtime_typesPubSubTypes.h"

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

  void on_status(const idl::Status& sample);
  void on_event(const idl::Event& sample);
  void on_snapshot(const idl::Snapshot& sample);
  void on_health(const idl::Health& sample);
  bool send(const service::Request& request);
  [[nodiscard]] result::Result<service::Reply> ask_once(const service::RequestBody& body);
  tl::unexpected<result::Diagnostics> nobody_answers() const;
  bool link_is_older(const service::RequestBody& body) const;
  // Says until it is stopped that this supervisor lives.
  void beat(const std::stop_token& stop, const std::string& process, std::uint64_t client);
  // Asks for missing events, at most every `kResendPeriod`, and learns what the runtime has forgotten.
  void fetch_missing(std::unique_lock<std::mutex>& lock);

  std::unique_ptr<Participant> participant_;
  const std::string place_;
  const bool supervises_;
  RequestTable requests_;
  Namesakes namesakes_;

  mutable std::mutex mutex_;
  std::condition_variable news_;
  bool runtime_connected_ = false;
  std::optional<RuntimeStatus> status_;
  std::optional<Snapshot> snapshot_;
  bool snapshot_is_new_ = false;  // nobody has waited for it
  std::condition_variable snapshot_news_;
  std::optional<RuntimeHealth> health_;
  EventOrder events_;
  std::uint64_t fetch_id_ = 0;  // the open ResendEvents request, 0 = none
  Clock::time_point fetch_at_{};

  Writer<idl::CommandPubSubType> commands_;
  Writer<idl::ProgramChunkPubSubType> chunks_;
  Writer<idl::ExtraCommandPubSubType> extras_;
  std::unique_ptr<Writer<idl::PresencePubSubType>> presence_;  // a supervisor only
  std::jthread heart_;                                         // writes it
  // Last, so that they are silent before what their handlers use is gone.
  Reader<idl::ReplyPubSubType> reply_reader_;
  Reader<idl::EventPubSubType> event_reader_;
  Reader<idl::SnapshotPubSubType> snapshot_reader_;
  Reader<idl::HealthPubSubType> health_reader_;
  Reader<idl::StatusPubSubType> status_reader_;
};

}  // namespace stepwright::dds::internal
