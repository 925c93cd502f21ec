#include "cell/hmi/unread_inputs.h"

#include <algorithm>

#include "hmi_web/server/image_value.h"

namespace stepwright::hmi {
namespace {

using protocol::Unread;

// None: it answers.
std::optional<Unread> why_unread(const modbus::client::Device& device,
                                 const std::optional<dds::RuntimeHealth>& health) {
  if (!health || !health->devices_known) return Unread::Untold;
  const auto known = std::ranges::find(health->devices, device.name, &dds::DeviceHealth::name);
  if (known == health->devices.end()) return Unread::Untold;
  if (known->answer_age_ms < 0) return Unread::Never;
  return known->lost ? std::optional(Unread::Lost) : std::nullopt;
}

// Who has named a value for the loss wants it to count.
bool has_loss_value(const modbus::client::Tag& tag) {
  return tag.on_loss != modbus::client::LossValue::Hold;
}

std::vector<reader::Variable> inputs_of(const modbus::client::Device& device) {
  std::vector<reader::Variable> inputs;
  for (const modbus::client::Group& group : device.groups) {
    for (const modbus::client::Tag& tag : group.inputs) {
      // The area of inputs begins the image.
      auto input = server::variable_at(tag.address, 0);
      if (input && !has_loss_value(tag)) inputs.push_back(std::move(*input));
    }
  }
  return inputs;
}

}  // namespace

std::vector<server::UnreadInputs> unread_inputs(const modbus::client::ClientSettings& settings,
                                                const std::optional<dds::RuntimeHealth>& health) {
  std::vector<server::UnreadInputs> unread;
  for (const modbus::client::Device& device : settings.devices) {
    const auto why = why_unread(device, health);
    if (!why) continue;
    if (auto inputs = inputs_of(device); !inputs.empty())
      unread.push_back({device.name, *why, std::move(inputs)});
  }
  return unread;
}

}  // namespace stepwright::hmi
