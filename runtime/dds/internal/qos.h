#pragma once

// Every quality-of-service choice of Stepwright, in one place (qos.cpp says why each).

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <string>

namespace stepwright::dds::internal {

// How many processes of one domain find each other on this machine.
inline constexpr std::int32_t kParticipantsPerDomain = 24;

enum class Profile {
  Request,   // Command, ProgramChunk, Reply, OperatorRequest: reliable, kept until delivered
  Event,     // Event: reliable, a bounded queue
  Status,    // Status: best effort, newest only
  Snapshot,  // Snapshot: best effort, newest only, large
  Document,  // PlanDocument: reliable, the newest one also for those who join late
  Presence,  // Presence: reliable, newest, for those who join late; watched for liveliness
};

eprosima::fastdds::dds::DomainParticipantQos participant_qos(const std::string& name);
eprosima::fastdds::dds::DataWriterQos writer_qos(Profile profile);
eprosima::fastdds::dds::DataReaderQos reader_qos(Profile profile);

}  // namespace stepwright::dds::internal
