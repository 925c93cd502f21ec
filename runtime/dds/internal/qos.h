#pragma once

// Every quality-of-service choice of Stepwright, in one place (qos.cpp says why each).

#include <chrono>
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <string>

#include "runtime/dds/types.h"

namespace stepwright::dds::internal {

// How many processes of one domain find each other on this machine.
inline constexpr std::int32_t kParticipantsPerDomain = 24;

// A writer of heartbeats must write this often; who is silent for the lease is dead.
inline constexpr std::chrono::milliseconds kHeartbeatPeriod{80};
inline constexpr std::chrono::milliseconds kHeartbeatLease{300};

enum class Profile {
  Queue,      // requests and answers, of runtime and supervisor, and events: reliable, a bounded queue
  Heartbeat,  // status, presence: best effort, newest only; each sample says that its writer lives
  Picture,    // snapshot, health, beacon: best effort, newest only, large
  Document,   // PlanDocument, on three topics: reliable, the newest one also for those who join late
};

eprosima::fastdds::dds::DomainParticipantQos participant_qos(const ParticipantConfig& config);
eprosima::fastdds::dds::DataWriterQos writer_qos(Profile profile);
eprosima::fastdds::dds::DataReaderQos reader_qos(Profile profile);

}  // namespace stepwright::dds::internal
