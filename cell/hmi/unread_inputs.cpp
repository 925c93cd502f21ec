#include "cell/hmi/unread_inputs.h"

#include <algorithm>

#include "hmi_web/server/image_value.h"

namespace stepwright::hmi {
namespace {

bool answers(const modbus::client::Device& device, const std::optional<dds::RuntimeHealth>& health) {
  if (!health || !health->devices_known) return false;
  const auto known = std::ranges::find(health->devices, device.name, &dds::DeviceHealth::name);
  return known != health->devices.end() && !known->lost && known->answer_age_ms >= 0;
}

// Who has named a value for the loss wants it to count.
bool has_loss_value(const modbus::client::Tag& tag) {
  return tag.on_loss != modbus::client::LossValue::Hold;
}

}  // namespace

std::vector<reader::Variable> unread_inputs(const modbus::client::ClientSettings& settings,
                                            const std::optional<dds::RuntimeHealth>& health) {
  std::vector<reader::Variable> inputs;
  for (const modbus::client::Device& device : settings.devices) {
    if (answers(device, health)) continue;
    for (const modbus::client::Group& group : device.groups) {
      for (const modbus::client::Tag& tag : group.inputs) {
        // The area of inputs begins the image.
        auto input = server::variable_at(tag.address, 0);
        if (input && !has_loss_value(tag)) inputs.push_back(std::move(*input));
      }
    }
  }
  return inputs;
}

}  // namespace stepwright::hmi
