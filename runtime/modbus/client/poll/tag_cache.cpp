#include "runtime/modbus/client/poll/tag_cache.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "runtime/modbus/client/poll/conversion.h"

namespace stepwright::modbus::client {
namespace {

using std::chrono::duration_cast;
using std::chrono::milliseconds;

// Who asks may have looked at the clock before the value came: it is new then.
std::int64_t age_ms(TagCache::Clock::time_point read, TagCache::Clock::time_point now) {
  return std::max<std::int64_t>(0, duration_cast<milliseconds>(now - read).count());
}

}  // namespace

TagCache::TagCache(std::vector<Device> devices, Clock::time_point start) : devices_(std::move(devices)) {
  for (const Device& device : devices_) {
    DeviceState state;
    state.offline_since = start;
    state.error = "not connected yet";
    for (const Group& group : device.groups) {
      for (const Tag& tag : group.inputs) {
        state.inputs.push_back(tag);
        state.limits.push_back(std::max(device.loss_after, 2 * group.period));
      }
      state.outputs.insert(state.outputs.end(), group.outputs.begin(), group.outputs.end());
      state.groups.push_back({group.name, group.period.count(), 0, 0, {}});
    }
    State fresh;
    fresh.good_at = start;
    state.in.assign(state.inputs.size(), fresh);
    state.out.assign(state.outputs.size(), fresh);
    states_.push_back(std::move(state));
  }
}

void TagCache::read(std::size_t device, const ReadRequest& request, std::span<const std::uint16_t> words,
                    Clock::time_point now) {
  const auto wall = std::chrono::system_clock::now();
  const std::scoped_lock lock(mutex_);
  DeviceState& known = states_[device];
  for (const std::uint32_t index : request.tags) {
    const Tag& tag = known.inputs[index];
    const ImageValue value = to_image(tag, words.subspan(tag.first - request.first, tag.count()));
    State& state = known.in[index];
    if (!value.not_a_number) state.bits = value.bits;
    state.exceeded = value.exceeded || value.not_a_number;
    state.ever = true;
    state.fault = Quality::Good;
    state.good_at = now;
    state.wall = wall;
  }
}

void TagCache::not_read(std::size_t device, std::span<const std::uint32_t> inputs, Quality why,
                        const std::string& error) {
  const std::scoped_lock lock(mutex_);
  if (states_[device].online) states_[device].error = error;  // else offline() tells
  for (const std::uint32_t index : inputs) states_[device].in[index].fault = why;
}

void TagCache::written(std::size_t device, std::span<const std::uint32_t> outputs,
                       std::span<const std::uint8_t> exceeded, Clock::time_point now) {
  const auto wall = std::chrono::system_clock::now();
  const std::scoped_lock lock(mutex_);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    State& state = states_[device].out[outputs[i]];
    state.exceeded = exceeded[i] != 0;
    state.ever = true;
    state.fault = Quality::Good;
    state.fault_since = {};
    state.good_at = now;
    state.wall = wall;
  }
}

void TagCache::not_written(std::size_t device, std::span<const std::uint32_t> outputs, Quality why,
                           const std::string& error, Clock::time_point now) {
  const std::scoped_lock lock(mutex_);
  if (states_[device].online) states_[device].error = error;
  for (const std::uint32_t index : outputs) {
    State& state = states_[device].out[index];
    state.fault = why;
    if (state.fault_since == Clock::time_point{}) state.fault_since = now;
  }
}

void TagCache::outputs_are(std::span<const std::byte> area) {
  const std::scoped_lock lock(mutex_);
  for (DeviceState& device : states_) {
    for (std::size_t i = 0; i < device.outputs.size(); ++i)
      device.out[i].bits = get_field(area, device.outputs[i].field);
  }
}

void TagCache::online(std::size_t device, Clock::time_point) {
  const std::scoped_lock lock(mutex_);
  DeviceState& state = states_[device];
  if (state.online) return;
  state.online = true;
  state.error.clear();
  news_.push_back({devices_[device].name, true, ""});
}

void TagCache::offline(std::size_t device, Quality why, const std::string& error, Clock::time_point now) {
  const std::scoped_lock lock(mutex_);
  DeviceState& state = states_[device];
  const bool told = !state.online && state.error == error;
  for (State& input : state.in) input.fault = why;
  for (State& output : state.out) {
    // What was never written is nobody's loss yet.
    if (output.ever && output.fault_since == Clock::time_point{}) output.fault_since = now;
    output.fault = why;
  }
  if (state.online) state.offline_since = now;
  state.online = false;
  state.error = error;
  if (!told) news_.push_back({devices_[device].name, false, error});
}

void TagCache::count(std::size_t device,
                     const std::function<void(DeviceCounters&, std::vector<GroupStatus>&)>& change) {
  const std::scoped_lock lock(mutex_);
  change(states_[device].counters, states_[device].groups);
}

bool TagCache::too_old(const DeviceState& device, std::size_t input, Clock::time_point now) {
  return now - device.in[input].good_at > device.limits[input];
}

Quality TagCache::quality_of(const State& state, bool too_old) {
  if (!state.ever) return state.fault == Quality::Good ? Quality::NotConnected : state.fault;
  if (too_old) return state.fault == Quality::Good ? Quality::CommFailure : state.fault;
  if (state.fault != Quality::Good) return Quality::LastUsable;
  return state.exceeded ? Quality::RangeExceeded : Quality::Good;
}

void TagCache::collect(Clock::time_point now, std::span<std::byte> inputs) const {
  const auto put_worth = [&](const Tag& tag, const State& state, Quality quality) {
    if (tag.quality_byte) inputs[*tag.quality_byte] = static_cast<std::byte>(quality);
    if (!tag.age) return;
    const double age =
        state.ever ? static_cast<double>(age_ms(state.good_at, now)) : std::numeric_limits<double>::max();
    put_field(inputs, *tag.age, image_bits_of(tag.age->type, age));
  };
  const std::scoped_lock lock(mutex_);
  for (std::size_t d = 0; d < states_.size(); ++d) {
    const DeviceState& device = states_[d];
    for (std::size_t i = 0; i < device.inputs.size(); ++i) {
      const Tag& tag = device.inputs[i];
      const State& state = device.in[i];
      const bool old = too_old(device, i, now);
      const bool replaced = (old || !state.ever) && tag.on_loss != LossValue::Hold;
      const double loss_value = tag.on_loss == LossValue::Value ? tag.loss_value : 0.0;
      put_field(inputs, tag.field, replaced ? image_bits_of(tag.field.type, loss_value) : state.bits);
      put_worth(tag, state, quality_of(state, old));
    }
    for (std::size_t i = 0; i < device.outputs.size(); ++i)
      put_worth(device.outputs[i], device.out[i],
                quality_of(device.out[i], device.out[i].fault != Quality::Good));
    if (const auto bit = devices_[d].online_bit)
      put_field(inputs, {*bit / 8, static_cast<std::uint8_t>(*bit % 8), ImageType::Bool},
                device.online ? 1 : 0);
  }
}

bool TagCache::lost(std::size_t device, Clock::time_point now) const {
  const DeviceState& state = states_[device];
  const milliseconds limit = devices_[device].loss_after;
  if (!state.online && now - state.offline_since > limit) return true;
  for (std::size_t i = 0; i < state.in.size(); ++i) {
    if (!state.in[i].ever || too_old(state, i, now)) return true;
  }
  return std::ranges::any_of(state.out, [&](const State& output) {
    return output.fault_since != Clock::time_point{} && now - output.fault_since > limit;
  });
}

bool TagCache::lost(Clock::time_point now) const {
  const std::scoped_lock lock(mutex_);
  for (std::size_t d = 0; d < states_.size(); ++d) {
    if (devices_[d].on_loss == OnLoss::Safe && lost(d, now)) return true;
  }
  return false;
}

void TagCache::report(Clock::time_point now, std::vector<DeviceStatus>& status) const {
  const std::scoped_lock lock(mutex_);
  for (std::size_t d = 0; d < states_.size(); ++d) {
    const DeviceState& state = states_[d];
    DeviceStatus said;
    said.name = devices_[d].name;
    said.endpoint = master::name_of(devices_[d].endpoint);
    said.unit = devices_[d].unit;
    said.online = state.online;
    said.lost = lost(d, now);
    said.error = state.error;
    said.counters = state.counters;
    said.groups = state.groups;
    const auto add = [&](const Tag& tag, const State& known, bool output, Quality quality) {
      said.tags.push_back({tag.name, tag.address, output, number_of(tag.field.type, known.bits), quality,
                           known.ever ? age_ms(known.good_at, now) : -1, known.wall});
    };
    for (std::size_t i = 0; i < state.in.size(); ++i)
      add(state.inputs[i], state.in[i], false, quality_of(state.in[i], too_old(state, i, now)));
    for (std::size_t i = 0; i < state.out.size(); ++i)
      add(state.outputs[i], state.out[i], true,
          quality_of(state.out[i], state.out[i].fault != Quality::Good));
    status.push_back(std::move(said));
  }
}

std::vector<DeviceNews> TagCache::take_news() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(news_, {});
}

}  // namespace stepwright::modbus::client
