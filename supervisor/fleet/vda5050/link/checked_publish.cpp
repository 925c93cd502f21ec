#include "supervisor/fleet/vda5050/link/checked_publish.h"

#include "supervisor/fleet/vda5050/check_message.h"

namespace stepwright::vda5050_link {

bool publish_checked(mqtt::Client& client, const fleet::vda5050::Address& address,
                     fleet::vda5050::Topic topic, const std::string& text, result::Diagnostics& wrong) {
  const std::string name = topic_name(address, topic);
  const result::Diagnostics found = check_message(topic, text, name);
  wrong.insert(wrong.end(), found.begin(), found.end());
  if (!found.empty()) return false;
  const auto delivery = delivery_of(topic);
  return client.publish(name, text, delivery.qos, delivery.retained);
}

}  // namespace stepwright::vda5050_link
