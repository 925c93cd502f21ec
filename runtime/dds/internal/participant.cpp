#include "runtime/dds/internal/participant.h"

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/topic/Topic.hpp>

namespace stepwright::dds::internal {
namespace {

result::Result<std::unique_ptr<Participant>> refuse(const ParticipantConfig& config, const char* what) {
  return result::fail("D0005", {},
                      "Fast DDS cannot create " + std::string(what) + " for '" + config.name +
                          "' in domain " + std::to_string(config.domain_id),
                      "another domain id may help where too many processes share one");
}

}  // namespace

result::Result<std::unique_ptr<Participant>> Participant::create(const ParticipantConfig& config) {
  if (config.domain_id > 232 || config.runtime_id.empty() || config.runtime_id.size() > host::kMaxNameBytes) {
    return result::fail("D0004", {}, "the domain id is above 232 or the runtime id has no 1 to 64 bytes");
  }
  std::unique_ptr<Participant> self(new Participant());
  self->runtime_id_ = config.runtime_id;
  // A profile file in the working folder must not change how a cell communicates.
  auto* factory = fdds::DomainParticipantFactory::get_instance();
  self->participant_ = factory->create_participant(config.domain_id, participant_qos(config.name));
  if (self->participant_ == nullptr) return refuse(config, "a participant");
  fdds::PublisherQos publisher_qos = fdds::PUBLISHER_QOS_DEFAULT;
  publisher_qos.partition().push_back(config.runtime_id.c_str());
  self->publisher_ = self->participant_->create_publisher(publisher_qos);
  fdds::SubscriberQos subscriber_qos = fdds::SUBSCRIBER_QOS_DEFAULT;
  subscriber_qos.partition().push_back(config.runtime_id.c_str());
  self->subscriber_ = self->participant_->create_subscriber(subscriber_qos);
  if (self->publisher_ == nullptr || self->subscriber_ == nullptr) return refuse(config, "an endpoint");
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
