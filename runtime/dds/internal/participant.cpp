#include "runtime/dds/internal/participant.h"

#include <fastrtps/xmlparser/XMLProfileManager.h>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/topic/Topic.hpp>

#include <algorithm>
#include <cctype>
#include <set>
#include <span>
#include <vector>

#include "runtime/dds/internal/addresses.h"
#include "runtime/host/limits.h"
#include "runtime/service/digest.h"

#if defined(__SANITIZE_ADDRESS__)
// Debian's libfastrtps 2.9.1 deletes a statistics object of 64 bytes as one of 56, which is its own affair.
// Every program that links Fast DDS gets this default; ASAN_OPTIONS still wins.
extern "C" const char* __asan_default_options() {
  return "new_delete_type_mismatch=0";
}
#endif

namespace stepwright::dds::internal {
namespace {

result::Result<std::unique_ptr<Participant>> refuse(const ParticipantConfig& config, const char* what) {
  return result::fail("D0005", {},
                      "Fast DDS cannot create " + std::string(what) + " for '" + config.name +
                          "' in domain " + std::to_string(config.domain_id),
                      "another domain id may help where too many processes share one");
}

// The id is the name of a partition, where Fast DDS would take '*' and '?' as a pattern.
bool valid_id(const std::string& id) {
  return !id.empty() && id.size() <= host::kMaxNameBytes &&
         std::all_of(id.begin(), id.end(), [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
         });
}

// Who says no place meets all of the name, those without a place included: a name of a partition may be a
// pattern, which no id contains.
std::vector<std::string> partitions_of(const ParticipantConfig& config, Scope scope) {
  constexpr std::size_t kLetters = 16;
  if (scope == Scope::Domain) return {"/"};
  const std::string all = config.runtime_id + "@";
  if (config.place.empty()) return {all, all + "*"};
  const auto bytes = std::as_bytes(std::span(config.place));
  return {all + service::to_hex(service::sha256(bytes)).substr(0, kLetters)};
}

// Fast DDS 2.9 delivers between participants of one process by calling the other one's reader directly, under
// locks that two participants which assert their liveliness take in opposite orders: they deadlock. Once,
// before the first participant.
void keep_to_sockets() {
  [[maybe_unused]] static const bool done = [] {
    eprosima::fastrtps::LibrarySettingsAttributes settings;
    settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
    eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(settings);
    return true;
  }();
}

// Left alone, Fast DDS never gives a participant number out twice in one process, so that after some
// reconnections a process would sit on ports that nobody announces to. Take the lowest number that this
// process does not use in the domain; where another process has its ports, Fast DDS itself moves on to the
// next free ones.
fdds::DomainParticipant* create_lowest(const ParticipantConfig& config) {
  keep_to_sockets();
  auto* factory = fdds::DomainParticipantFactory::get_instance();
  std::set<std::int32_t> used;
  for (const fdds::DomainParticipant* other : factory->lookup_participants(config.domain_id)) {
    used.insert(other->get_qos().wire_protocol().participant_id);
  }
  fdds::DomainParticipantQos qos = participant_qos(config);
  fdds::DomainParticipant* created = nullptr;
  for (std::int32_t number = 0; created == nullptr && number < kParticipantsPerDomain; ++number) {
    if (used.contains(number)) continue;
    qos.wire_protocol().participant_id = number;
    created = factory->create_participant(config.domain_id, qos);
  }
  return created;
}

}  // namespace

result::Result<std::unique_ptr<Participant>> Participant::create(const ParticipantConfig& config) {
  if (config.domain_id > 232) {
    return result::fail("D0004", {}, "the domain id " + std::to_string(config.domain_id) + " is above 232");
  }
  if (!valid_id(config.runtime_id)) {
    return result::fail("D0004", {}, "'" + config.runtime_id + "' cannot name a runtime",
                        "1 to 64 letters, digits, '_', '-' and '.'");
  }
  if (auto usable = check_addresses(config); !usable) return result::forward(usable);
  std::unique_ptr<Participant> self(new Participant(config.on_trouble));
  self->runtime_id_ = config.runtime_id;
  // A profile file in the working folder must not change how a cell communicates.
  self->participant_ = create_lowest(config);
  if (self->participant_ == nullptr) return refuse(config, "a participant");
  for (const Scope scope : {Scope::Runtime, Scope::Domain}) {
    fdds::PublisherQos publisher_qos = fdds::PUBLISHER_QOS_DEFAULT;
    fdds::SubscriberQos subscriber_qos = fdds::SUBSCRIBER_QOS_DEFAULT;
    for (const std::string& partition : partitions_of(config, scope)) {
      publisher_qos.partition().push_back(partition.c_str());
      subscriber_qos.partition().push_back(partition.c_str());
    }
    const auto i = static_cast<std::size_t>(scope);
    self->publishers_[i] = self->participant_->create_publisher(publisher_qos);
    self->subscribers_[i] = self->participant_->create_subscriber(subscriber_qos);
    if (self->publishers_[i] == nullptr || self->subscribers_[i] == nullptr)
      return refuse(config, "an endpoint");
  }
  return self;
}

Participant::~Participant() {
  if (participant_ == nullptr) return;
  participant_->delete_contained_entities();
  fdds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

fdds::Topic* Participant::topic(const char* name, const fdds::TypeSupport& type) {
  if (auto* existing = dynamic_cast<fdds::Topic*>(participant_->lookup_topicdescription(name)))
    return existing;
  if (type.register_type(participant_) != ReturnCode_t::RETCODE_OK) return nullptr;
  return participant_->create_topic(name, type.get_type_name(), fdds::TOPIC_QOS_DEFAULT);
}

}  // namespace stepwright::dds::internal
