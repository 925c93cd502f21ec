#include "runtime/dds/internal/qos.h"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include <memory>

namespace stepwright::dds::internal {
namespace {

using namespace eprosima::fastdds::dds;
using eprosima::fastdds::rtps::UDPv4TransportDescriptor;
using eprosima::fastrtps::Duration_t;
using eprosima::fastrtps::rtps::IPLocator;
using eprosima::fastrtps::rtps::Locator_t;

// Announcing this often makes two processes find each other in well under a second, whoever comes first.
const Duration_t kAnnouncement(0, 330'000'000u);
const Duration_t kParticipantLease(1, 0);
// A sender that is blocked for longer gives up; requests are repeated and events fetched again.
const Duration_t kMaxBlocking(0, 50'000'000u);
constexpr std::uint32_t kSocketBufferBytes = 4u << 20;
constexpr std::int32_t kQueuedSamples = 512;

// Of all participants of all domains (RTPS 2.3, 9.6.1.4.1).
constexpr const char* kDiscoveryGroup = "239.255.0.1";
constexpr std::uint32_t kPortBase = 7'400;
constexpr std::uint32_t kPortsPerDomain = 250;

// Its port follows from domain and participant.
Locator_t locator(const std::string& address) {
  Locator_t where;
  where.kind = LOCATOR_KIND_UDPv4;
  IPLocator::setIPv4(where, address);
  return where;
}

bool is_loopback(const std::string& address) {
  return address.starts_with("127.");
}

template <typename Qos>
void apply(Profile profile, Qos& qos) {
  const bool best_effort = profile == Profile::Heartbeat || profile == Profile::Picture;
  qos.reliability().kind = best_effort ? BEST_EFFORT_RELIABILITY_QOS : RELIABLE_RELIABILITY_QOS;
  qos.reliability().max_blocking_time = kMaxBlocking;
  qos.history().kind = profile == Profile::Queue ? KEEP_ALL_HISTORY_QOS : KEEP_LAST_HISTORY_QOS;
  qos.history().depth = 1;
  qos.durability().kind =
      profile == Profile::Document ? TRANSIENT_LOCAL_DURABILITY_QOS : VOLATILE_DURABILITY_QOS;
  // One instance per runtime in a partition of its own; the queue is bounded, so that a reader that stopped
  // reading costs memory up to here and no further.
  qos.resource_limits().max_instances = 8;
  qos.resource_limits().max_samples_per_instance = kQueuedSamples;
  qos.resource_limits().max_samples = 8 * kQueuedSamples;
  qos.resource_limits().allocated_samples = 8;
  if (profile == Profile::Heartbeat) {
    // Not automatic: there any living participant keeps all dead writers of a domain alive (Fast DDS issue
    // 4373, in 2.9). And a process that hangs is as good as dead, which only samples of its own show.
    qos.liveliness().kind = MANUAL_BY_TOPIC_LIVELINESS_QOS;
    qos.liveliness().lease_duration = Duration_t(0, std::chrono::nanoseconds(kHeartbeatLease).count());
  }
  // No memory is shared between processes: one that dies in the middle of a write leaves nothing behind.
  qos.data_sharing().off();
  // Bounds are far above the usual size: take memory for what is sent, not for what might be.
  qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::DYNAMIC_RESERVE_MEMORY_MODE;
}

}  // namespace

DomainParticipantQos participant_qos(const ParticipantConfig& config) {
  DomainParticipantQos qos;
  qos.name(config.name);
  auto udp = std::make_shared<UDPv4TransportDescriptor>();
  // Loopback only, unless the cell lists other interfaces: nothing is reachable from elsewhere by itself.
  udp->interfaceWhiteList = config.interfaces;
  udp->maxInitialPeersRange = static_cast<std::uint32_t>(kParticipantsPerDomain);
  udp->sendBufferSize = kSocketBufferBytes;
  udp->receiveBufferSize = kSocketBufferBytes;
  udp->non_blocking_send = true;
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp);
  // The loopback interface carries no multicast on most machines: announce to each possible process instead.
  // A listed locator for incoming announcements keeps Fast DDS from adding its multicast one.
  auto& builtin = qos.wire_protocol().builtin;
  bool multicast = false;
  for (const std::string& address : config.interfaces) {
    const Locator_t here = locator(address);
    builtin.metatrafficUnicastLocatorList.push_back(here);
    if (is_loopback(address)) builtin.initialPeersList.push_back(here);
    multicast = multicast || !is_loopback(address);
  }
  if (multicast) {
    // Left to itself, Fast DDS would announce to the group on the unicast ports of single participants.
    Locator_t group = locator(kDiscoveryGroup);
    group.port = kPortBase + kPortsPerDomain * config.domain_id;
    builtin.metatrafficMulticastLocatorList.push_back(group);
    builtin.initialPeersList.push_back(group);
  }
  for (const std::string& address : config.peers) builtin.initialPeersList.push_back(locator(address));
  auto& discovery = qos.wire_protocol().builtin.discovery_config;
  discovery.leaseDuration = kParticipantLease;
  discovery.leaseDuration_announcementperiod = kAnnouncement;
  return qos;
}

DataWriterQos writer_qos(Profile profile) {
  DataWriterQos qos = DATAWRITER_QOS_DEFAULT;
  apply(profile, qos);
  // What somebody waits for leaves on the caller's thread; pictures for people leave when Fast DDS has time,
  // so that a large one does not hold up an answer.
  const bool picture = profile == Profile::Picture || profile == Profile::Document;
  qos.publish_mode().kind = picture ? ASYNCHRONOUS_PUBLISH_MODE : SYNCHRONOUS_PUBLISH_MODE;
  // A lost datagram on loopback is rare but costs a whole heartbeat period: keep it short.
  qos.reliable_writer_qos().times.heartbeatPeriod = Duration_t(0, 50'000'000u);
  qos.reliable_writer_qos().times.nackResponseDelay = Duration_t(0, 1'000'000u);
  return qos;
}

DataReaderQos reader_qos(Profile profile) {
  DataReaderQos qos = DATAREADER_QOS_DEFAULT;
  apply(profile, qos);
  qos.reliable_reader_qos().times.heartbeatResponseDelay = Duration_t(0, 1'000'000u);
  return qos;
}

}  // namespace stepwright::dds::internal
