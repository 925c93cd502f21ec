#pragma once

// One process in a Fast DDS domain: participant, publisher and subscriber in the partition of a runtime, and
// typed endpoints on it. Only the .cpp files of runtime/dds include this header.
//
// Threads: Fast DDS calls handlers from its own receive threads, one at a time for one reader. An endpoint
// that is destroyed waits for the handler that runs. Endpoints must be destroyed before their participant.

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <functional>
#include <memory>
#include <string>

#include "runtime/dds/health.h"
#include "runtime/dds/internal/qos.h"
#include "runtime/dds/internal/trouble.h"
#include "runtime/dds/types.h"
#include "runtime/ground/result/result.h"

namespace stepwright::dds::internal {

namespace fdds = eprosima::fastdds::dds;

// Whom an endpoint meets: the processes of one runtime, or all of the domain.
enum class Scope : std::uint8_t { Runtime, Domain };

class Participant {
 public:
  // Fails with D0005, for example when every participant number of the domain is taken.
  [[nodiscard]] static result::Result<std::unique_ptr<Participant>> create(const ParticipantConfig& config);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  const std::string& runtime_id() const { return runtime_id_; }
  // Whom readers tell of samples that they refuse.
  Trouble& trouble() { return trouble_; }
  // The topic, created on first use; null if Fast DDS refuses.
  fdds::Topic* topic(const char* name, const fdds::TypeSupport& type);
  fdds::Publisher* publisher(Scope scope) const { return publishers_[static_cast<std::size_t>(scope)]; }
  fdds::Subscriber* subscriber(Scope scope) const { return subscribers_[static_cast<std::size_t>(scope)]; }

 private:
  explicit Participant(OnTrouble on_trouble) : trouble_(std::move(on_trouble)) {}
  fdds::DomainParticipant* participant_ = nullptr;
  std::array<fdds::Publisher*, 2> publishers_{};  // by scope
  std::array<fdds::Subscriber*, 2> subscribers_{};
  std::string runtime_id_;
  Trouble trouble_;
};

// A writer of samples of the generated type `PubSubType::type`.
template <typename PubSubType>
class Writer final : private fdds::DataWriterListener {
 public:
  using Sample = typename PubSubType::type;

  Writer(Participant& participant, const char* topic_name, Profile profile, Scope scope = Scope::Runtime)
      : participant_(participant), scope_(scope) {
    fdds::Topic* topic = participant.topic(topic_name, fdds::TypeSupport(new PubSubType()));
    if (topic != nullptr) {
      writer_ = participant.publisher(scope)->create_datawriter(topic, writer_qos(profile), this,
                                                                fdds::StatusMask::publication_matched());
    }
  }
  ~Writer() override {
    if (writer_ != nullptr) participant_.publisher(scope_)->delete_datawriter(writer_);
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  bool ok() const { return writer_ != nullptr; }
  // False if the queue stayed full for the blocking time.
  bool write(Sample& sample) { return writer_->write(&sample); }
  bool matched() const { return readers() > 0; }
  std::uint32_t readers() const {
    return static_cast<std::uint32_t>(std::max(0, matched_.load(std::memory_order_acquire)));
  }

 private:
  void on_publication_matched(fdds::DataWriter*, const fdds::PublicationMatchedStatus& status) override {
    matched_.store(status.current_count, std::memory_order_release);
  }

  Participant& participant_;
  Scope scope_;
  fdds::DataWriter* writer_ = nullptr;
  std::atomic<int> matched_{0};
};

// A reader that hands every valid sample to `on_sample` and, of heartbeats, every change of life to
// `on_alive`.
template <typename PubSubType>
class Reader final : private fdds::DataReaderListener {
 public:
  using Sample = typename PubSubType::type;
  using OnSample = std::function<void(Sample&)>;
  using OnAlive = std::function<void(bool)>;

  Reader(Participant& participant, const char* topic_name, Profile profile, OnSample on_sample,
         OnAlive on_alive = {}, Scope scope = Scope::Runtime)
      : participant_(participant),
        scope_(scope),
        name_(topic_name),
        on_sample_(std::move(on_sample)),
        on_alive_(std::move(on_alive)) {
    fdds::Topic* topic = participant.topic(topic_name, fdds::TypeSupport(new PubSubType()));
    if (topic != nullptr) {
      reader_ = participant.subscriber(scope)->create_datareader(
          topic, reader_qos(profile), this,
          fdds::StatusMask::data_available()
              << fdds::StatusMask::liveliness_changed() << fdds::StatusMask::subscription_matched()
              << fdds::StatusMask::sample_lost());
    }
  }
  ~Reader() override {
    if (reader_ == nullptr) return;
    reader_->set_listener(nullptr);
    participant_.subscriber(scope_)->delete_datareader(reader_);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  bool ok() const { return reader_ != nullptr; }
  // True while a writer of the topic is known: up to a second longer than it lives.
  bool matched() const { return matched_.load(std::memory_order_acquire) > 0; }
  // True while a writer of heartbeats lives; for Profile::Heartbeat only. Fast DDS tells of leases that end
  // and begin again from several threads, and the older news may come last: whoever is heard of is alive.
  bool alive() const { return alive_.load(std::memory_order_acquire) > 0 || heard_within(kHeartbeatLease); }
  // Samples received so far; `refused` is counted by the owner, which can decode them.
  TopicTraffic traffic() const {
    TopicTraffic traffic;
    traffic.topic = name_;
    traffic.writers = static_cast<std::uint32_t>(std::max(0, matched_.load(std::memory_order_acquire)));
    traffic.received = received_.load(std::memory_order_acquire);
    traffic.refused = refused_.load(std::memory_order_acquire);
    traffic.lost = lost_.load(std::memory_order_acquire);
    if (traffic.received > 0) {
      traffic.age_s = std::max(0.0, std::chrono::duration<double>(age_of_newest()).count());
    }
    return traffic;
  }
  // The handler found that a sample breaks a bound.
  void refuse() { refused_.fetch_add(1, std::memory_order_acq_rel); }

 private:
  using Clock = std::chrono::steady_clock;

  // Of what was received, if anything was.
  Clock::duration age_of_newest() const {
    return Clock::now() - Clock::time_point(Clock::duration(newest_.load(std::memory_order_acquire)));
  }
  bool heard_within(Clock::duration age) const {
    return received_.load(std::memory_order_acquire) > 0 && age_of_newest() < age;
  }
  void on_data_available(fdds::DataReader* reader) override {
    Sample sample;
    fdds::SampleInfo info;
    while (reader->take_next_sample(&sample, &info) == ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data) continue;
      newest_.store(Clock::now().time_since_epoch().count(), std::memory_order_release);
      received_.fetch_add(1, std::memory_order_acq_rel);
      on_sample_(sample);
    }
  }
  void on_sample_lost(fdds::DataReader*, const fdds::SampleLostStatus& status) override {
    lost_.store(static_cast<std::uint64_t>(std::max(0, status.total_count)), std::memory_order_release);
  }
  void on_liveliness_changed(fdds::DataReader*, const fdds::LivelinessChangedStatus& status) override {
    const bool before = alive_.exchange(status.alive_count, std::memory_order_acq_rel) > 0;
    if (on_alive_ && before != (status.alive_count > 0)) on_alive_(status.alive_count > 0);
  }

  void on_subscription_matched(fdds::DataReader*, const fdds::SubscriptionMatchedStatus& status) override {
    matched_.store(status.current_count, std::memory_order_release);
  }

  Participant& participant_;
  Scope scope_;
  const char* name_;  // one of topics.h
  OnSample on_sample_;
  OnAlive on_alive_;
  fdds::DataReader* reader_ = nullptr;
  std::atomic<int> matched_{0};
  std::atomic<int> alive_{0};
  std::atomic<std::uint64_t> received_{0};
  std::atomic<std::uint64_t> refused_{0};
  std::atomic<std::uint64_t> lost_{0};
  std::atomic<Clock::rep> newest_{0};
};

}  // namespace stepwright::dds::internal
